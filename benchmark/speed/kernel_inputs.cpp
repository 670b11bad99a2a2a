// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_inputs.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace mivo {
namespace {

class Numbers {
 public:
  float between(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  void fill(std::size_t n, float low, float high, std::vector<float>& values) {
    values.resize(n);
    for (float& value : values) value = between(low, high);
  }

 private:
  std::mt19937 engine_{1};
};

kernels::WarpParameters smallMotion() {
  kernels::WarpParameters p{};
  const float rotation[9] = {0.9999F, -0.0100F, 0.0050F, 0.0100F, 0.9999F,
                             -0.004F, -0.0050F, 0.0041F, 1.0F};
  std::copy(rotation, rotation + 9, p.rotation);
  p.translation[0] = 0.01F;
  p.has_row_motion = true;
  p.angular[1] = 0.005F;
  p.linear[0] = 0.002F;
  p.row_duration = 0.6F / KernelInputs::kHeight;
  p.first_row = -0.3F;
  p.fx = p.fy = 525.0F;
  p.cx = 319.5F;
  p.cy = 239.5F;
  p.right = KernelInputs::kWidth - 1;
  p.bottom = KernelInputs::kHeight - 1;
  return p;
}

}  // namespace

KernelInputs::KernelInputs(std::size_t n) : size(n), warp(smallMotion()) {
  Numbers numbers;
  gray.resize(static_cast<std::size_t>(kWidth * kHeight) + 64);
  for (unsigned char& pixel : gray) pixel = static_cast<unsigned char>(numbers.between(20, 235));
  numbers.fill(static_cast<std::size_t>(kPairsStride * (kHeight / 4 + 2)), 5.0F, 60.0F, pairs);
  depth.resize(static_cast<std::size_t>(kWidth * kHeight));
  for (std::uint16_t& step : depth) step = static_cast<std::uint16_t>(numbers.between(900, 3000));
  z.resize(n);
  x.resize(n);
  y.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    // Row by row, at random columns.
    const float row = 4.0F + (kHeight - 8.0F) * static_cast<float>(i) / static_cast<float>(n);
    z[i] = numbers.between(0.9F, 3.0F);
    x[i] = z[i] * (numbers.between(4.0F, kWidth - 4.0F) - warp.cx) / warp.fx;
    y[i] = z[i] * (std::floor(row) - warp.cy) / warp.fy;
  }
  u.resize(n);
  v.resize(n);
  visible.resize(n);
  kernels::scalar().warpPoints(warp, points(), n, u.data(), v.data(), visible.data());
  ones.assign(n, 1.0F);
  numbers.fill(n, 0.0F, 255.0F, value);
  numbers.fill(n, -60.0F, 60.0F, intensity);
  numbers.fill(n, 6.0F, 60.0F, local_contrast);
  numbers.fill(n, -12.0F, 12.0F, residual);
  numbers.fill(n, -0.5F, 0.5F, nx);
  numbers.fill(n, -0.5F, 0.5F, ny);
  numbers.fill(n, -0.9F, -0.6F, nz);
  numbers.fill(n, 50.0F, 400.0F, weight);
  for (std::vector<float>& column : jacobian) numbers.fill(n, -300.0F, 300.0F, column);
  for (std::vector<float>& column : second_derivative) numbers.fill(n, -900.0F, 900.0F, column);
  jacobian_rows.assign(n * kernels::kRowFloats, 0.0F);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      jacobian_rows[i * kernels::kRowFloats + k] = jacobian[k][i];
    }
  }
  numbers.fill(n, 0.0F, 0.999F, fraction);
  for (std::size_t i = 0; i < n; ++i) {
    // Alike as two views are: mostly the same bin, sometimes the next.
    const int bin = static_cast<int>(numbers.between(0.0F, kBins - 2.0F));
    reference_bin.push_back(bin);
    live_bin.push_back(std::min(kBins - 2, bin + (numbers.between(0.0F, 1.0F) < 0.3F ? 1 : 0)));
  }
  numbers.fill(static_cast<std::size_t>(kSide * kSide), -2.0F, 1.0F, log_ratio);
}

std::array<const float*, 6> KernelInputs::jacobians() const {
  std::array<const float*, 6> result{};
  for (std::size_t k = 0; k < 6; ++k) result[k] = jacobian[k].data();
  return result;
}

}  // namespace mivo
