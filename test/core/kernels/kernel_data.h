// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/kernels/kernels.h"

// Random input and edge cases for the kernels, with the lengths and offsets at which vector code
// tends to fail.

namespace mivo {
namespace testing {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Size of the small images that are sampled.
constexpr int kWidth = 67;
constexpr int kHeight = 45;

/// A rolling-shutter camera with images of this size, at another pose than the keyframe's.
inline kernels::WarpParameters warpParameters(kernels::Lens lens, bool has_row_motion) {
  kernels::WarpParameters p{};
  const float rotation[9] = {0.9987F,  -0.0399F, 0.0298F, 0.0404F, 0.9990F,
                             -0.0186F, -0.0290F, 0.0198F, 0.9994F};
  std::copy(rotation, rotation + 9, p.rotation);
  p.translation[0] = 0.05F;
  p.translation[1] = -0.03F;
  p.translation[2] = 0.02F;
  p.has_row_motion = has_row_motion;
  p.angular[0] = 0.03F;
  p.angular[1] = -0.04F;
  p.angular[2] = 0.02F;
  p.linear[0] = 0.01F;
  p.linear[1] = 0.02F;
  p.linear[2] = -0.01F;
  p.row_duration = 1.0F / kHeight;
  p.first_row = -0.5F;
  p.fx = 55.0F;
  p.fy = 56.0F;
  p.cx = 33.2F;
  p.cy = 21.7F;
  p.lens = lens;
  p.k1 = 0.2F;
  p.k2 = -0.3F;
  p.k3 = 0.1F;
  p.k4 = lens == kernels::Lens::kEquidistant ? -0.02F : 0.3F;
  p.k5 = -0.1F;
  p.k6 = 0.05F;
  if (lens != kernels::Lens::kEquidistant) {
    p.p1 = 0.001F;
    p.p2 = -0.002F;
  }
  p.max_squared_radius = 0.8F;
  p.right = kWidth - 1;
  p.bottom = kHeight - 1;
  return p;
}

constexpr kernels::Lens kLenses[] = {kernels::Lens::kNone, kernels::Lens::kPlumbBob,
                                     kernels::Lens::kRational, kernels::Lens::kEquidistant};

/// Each length from 0 to 3 vectors of the widest instruction set, and lengths around those of a
/// tile and of a partial sum.
inline std::vector<std::size_t> awkwardLengths() {
  std::vector<std::size_t> lengths;
  for (std::size_t n = 0; n <= 49; ++n) lengths.push_back(n);
  for (const std::size_t n : {63, 64, 65, 127, 200, 511, 513, 1100}) lengths.push_back(n);
  return lengths;
}

/// An array that starts at an unaligned address, with guard values at both ends.
class Array {
 public:
  Array(std::size_t n, std::size_t offset, float value = 0.0F)
      : values_(n + offset + 2 * kGuards, kUntouched), begin_(kGuards + offset), n_(n) {
    for (std::size_t i = 0; i < n; ++i) data()[i] = value;
  }
  float* data() { return values_.data() + begin_; }
  const float* data() const { return values_.data() + begin_; }
  float& operator[](std::size_t i) { return data()[i]; }
  float operator[](std::size_t i) const { return data()[i]; }
  std::size_t size() const { return n_; }

  void expectGuarded() const {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const bool is_outside = i < begin_ || i >= begin_ + n_;
      if (is_outside) {
        EXPECT_EQ(values_[i], kUntouched) << "outside of the array";
      }
    }
  }

 private:
  static constexpr std::size_t kGuards = 64;
  static constexpr float kUntouched = -12345.0F;
  std::vector<float> values_;
  std::size_t begin_;
  std::size_t n_;
};

class Numbers {
 public:
  explicit Numbers(unsigned seed) : engine_(seed) {}
  float between(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  bool chance(float probability) { return between(0.0F, 1.0F) < probability; }
  Array array(std::size_t n, std::size_t offset, float low, float high) {
    Array result(n, offset);
    for (std::size_t i = 0; i < n; ++i) result[i] = between(low, high);
    return result;
  }
  /// 1 or 0 at random.
  Array visible(std::size_t n, std::size_t offset, float share = 0.8F) {
    Array result(n, offset);
    for (std::size_t i = 0; i < n; ++i) result[i] = chance(share) ? 1.0F : 0.0F;
    return result;
  }

 private:
  std::mt19937 engine_;
};

/// Random columns, in the layout of a Jacobian.
template <std::size_t count>
class Columns {
 public:
  Columns(Numbers& numbers, std::size_t n, std::size_t offset, float low, float high) {
    for (std::size_t k = 0; k < count; ++k) {
      arrays_.push_back(numbers.array(n, offset, low, high));
      pointers_[k] = arrays_.back().data();
    }
  }
  const float* const* data() const { return pointers_.data(); }
  const float* operator[](std::size_t k) const { return pointers_[k]; }

 private:
  std::vector<Array> arrays_;
  std::array<const float*, count> pointers_{};
};

/// Compares the upper triangles of two 6 x 6 sums of products. The tolerance is relative to the sum
/// of magnitudes, which the diagonal bounds by the Cauchy-Schwarz inequality.
inline void expectNearTriangles(const double* actual, const double* expected, double tolerance) {
  const std::size_t diagonal[6] = {0, 6, 11, 15, 18, 20};
  std::size_t entry = 0;
  for (const std::size_t row : diagonal) {
    for (const std::size_t column : diagonal) {
      if (column < row) continue;
      EXPECT_NEAR(actual[entry], expected[entry],
                  tolerance * std::sqrt(expected[row] * expected[column]));
      ++entry;
    }
  }
}

/// Compares every vector backend with the reference at every length and at some offsets.
template <typename Test>
void forEachCase(const Test& test) {
  const std::vector<kernels::Backend> all = kernels::backends();
  for (std::size_t b = 1; b < all.size(); ++b) {
    for (const std::size_t n : awkwardLengths()) {
      for (const std::size_t offset : {0, 1, 3}) {
        SCOPED_TRACE(all[b].name + ", " + std::to_string(n) + " points, offset " +
                     std::to_string(offset));
        test(*all[b].kernels, n, offset);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

}  // namespace testing
}  // namespace mivo
