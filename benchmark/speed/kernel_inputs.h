// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/kernels/kernels.h"

namespace mivo {

/// Input of every kernel as a frame of 640 x 480 pixels gives it: `n` points all over the image in
/// reading order, as a keyframe has them, seen from a little further on.
struct KernelInputs {
  explicit KernelInputs(std::size_t n);

  kernels::ImageView image() const { return {nullptr, gray.data(), kWidth, kWidth, kHeight}; }
  kernels::ContrastView contrast() const { return {pairs.data(), kPairsStride, 6.0F}; }
  kernels::PointsView points() const { return {x.data(), y.data(), z.data()}; }
  kernels::BinsView referenceBins() const { return {reference_bin.data(), fraction.data()}; }
  kernels::BinsView liveBins() const { return {live_bin.data(), fraction.data()}; }
  std::array<const float*, 6> jacobians() const;

  static constexpr int kWidth = 640;
  static constexpr int kHeight = 480;
  static constexpr int kPairsStride = 2 * (kWidth / 4 + 2);
  static constexpr int kBins = 8;
  static constexpr int kSide = kBins + 2;

  std::size_t size;
  kernels::WarpParameters warp{};
  std::vector<unsigned char> gray;
  std::vector<float> pairs;
  std::vector<std::uint16_t> depth;  // millimeters
  std::vector<float> x, y, z;
  std::vector<float> u, v, visible, value, intensity, local_contrast, residual, ones;
  std::vector<float> nx, ny, nz, weight;
  std::array<std::vector<float>, 6> jacobian;
  std::array<std::vector<float>, 21> second_derivative;
  std::vector<float> jacobian_rows;
  std::vector<std::int32_t> reference_bin, live_bin;
  std::vector<float> fraction;
  std::vector<float> log_ratio;
};

}  // namespace mivo
