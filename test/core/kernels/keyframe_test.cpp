// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_data.h"

namespace mivo {
namespace {

using kernels::Kernels;
using testing::Array;
using testing::forEachCase;
using testing::Numbers;

constexpr float kUnset = -777.0F;

/// Pixels all over the image of a camera with a real lens.
kernels::WarpParameters cameraOf(kernels::Lens lens, bool has_row_motion) {
  kernels::WarpParameters p = testing::warpParameters(lens, has_row_motion);
  p.row_duration = 1.0F / 480.0F;
  p.fx = 525.0F;
  p.fy = 520.0F;
  p.cx = 319.5F;
  p.cy = 239.5F;
  if (lens == kernels::Lens::kEquidistant) {  // 120 degrees from corner to corner
    p.fx = p.fy = 260.0F;
    p.k1 = 0.05F;
    p.k2 = -0.02F;
    p.k3 = 0.01F;
    p.k4 = -0.002F;
    return p;
  }
  p.k1 = 0.26F;
  p.k2 = -0.95F;
  p.p1 = -0.005F;
  p.p2 = 0.003F;
  p.k3 = 1.16F;
  p.k4 = 0.1F;
  p.k5 = -0.2F;
  p.k6 = 0.3F;
  return p;
}

struct Input {
  Input(std::size_t n, std::size_t offset) {
    Numbers numbers(static_cast<unsigned>(n + 11));
    arrays.push_back(numbers.array(n, offset, 0.0F, 639.0F));
    arrays.push_back(numbers.array(n, offset, 0.0F, 479.0F));
    arrays.push_back(numbers.array(n, offset, 0.3F, 10.0F));
    for (int k = 0; k < 5; ++k) arrays.push_back(numbers.array(n, offset, -60.0F, 60.0F));
    // A pixel without gradient, and a corner of the image.
    for (std::size_t i = 0; i < n; i += 5) arrays[3][i] = arrays[4][i] = 0.0F;
    for (std::size_t i = 2; i < n; i += 7) arrays[0][i] = arrays[1][i] = 0.0F;
  }
  kernels::PixelsView view(bool with_second_derivative) const {
    const auto at = [&](std::size_t k) { return arrays[k].data(); };
    const auto second = [&](std::size_t k) { return with_second_derivative ? at(k) : nullptr; };
    return {at(0), at(1), at(2), at(3), at(4), second(5), second(6), second(7)};
  }
  std::vector<Array> arrays;
};

struct Output {
  Output(std::size_t n, std::size_t offset) {
    for (int k = 0; k < 3 + 6 + 21; ++k) arrays.emplace_back(n, offset, kUnset);
  }
  kernels::DerivedPoints view() {
    kernels::DerivedPoints points{arrays[0].data(), arrays[1].data(), arrays[2].data(), {}, {}};
    for (std::size_t k = 0; k < 6; ++k) points.jacobian[k] = arrays[3 + k].data();
    for (std::size_t k = 0; k < 21; ++k) points.second_derivative[k] = arrays[9 + k].data();
    return points;
  }
  std::vector<Array> arrays;
  double motion[21] = {};
};

/// Largest magnitude of an entry over all columns from `first` on; tolerances are relative to it.
float largest(const std::vector<Array>& arrays, std::size_t first, std::size_t count,
              std::size_t i) {
  float result = 0.0F;
  for (std::size_t k = first; k < first + count; ++k) {
    result = std::max(result, std::abs(arrays[k][i]));
  }
  return result;
}

void expectAgreement(const Output& actual, const Output& expected, std::size_t n,
                     bool with_second_derivative) {
  const std::size_t groups[3][2] = {{0, 3}, {3, 6}, {9, 21}};
  const float tolerance[3] = {2e-6F, 1e-5F, 3e-5F};
  for (std::size_t g = 0; g < 3; ++g) {
    for (std::size_t i = 0; i < n; ++i) {
      const float size = largest(expected.arrays, groups[g][0], groups[g][1], i);
      for (std::size_t k = groups[g][0]; k < groups[g][0] + groups[g][1]; ++k) {
        if (g == 2 && !with_second_derivative) {
          EXPECT_EQ(actual.arrays[k][i], kUnset) << "was not asked for";
        } else {
          EXPECT_NEAR(actual.arrays[k][i], expected.arrays[k][i], tolerance[g] * size) << k;
        }
      }
    }
  }
  testing::expectNearTriangles(actual.motion, expected.motion, 1e-5);
  for (const Array& array : actual.arrays) array.expectGuarded();
}

TEST(VectorKeyframeTest, PointsAgreeWithTheReference) {
  for (const kernels::Lens lens : testing::kLenses) {
    for (const bool has_row_motion : {false, true}) {
      for (const bool with_second_derivative : {false, true}) {
        const kernels::WarpParameters camera = cameraOf(lens, has_row_motion);
        forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
          const Input input(n, offset);
          Output expected(n, offset);
          Output actual(n, offset);
          kernels::scalar().keyframePoints(camera, input.view(with_second_derivative), n,
                                           expected.view(), expected.motion);
          kernels.keyframePoints(camera, input.view(with_second_derivative), n, actual.view(),
                                 actual.motion);
          expectAgreement(actual, expected, n, with_second_derivative);
        });
      }
    }
  }
}

}  // namespace
}  // namespace mivo
