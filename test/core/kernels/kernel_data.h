// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "mivo/core/kernels/kernels.h"

// Random and awkward input for the kernels, and the lengths and offsets at which vector code goes
// wrong.

namespace mivo {
namespace testing {

/// 0 to 3 vectors of the widest instruction set, one by one, and around a tile and a sum.
inline std::vector<std::size_t> awkwardLengths() {
  std::vector<std::size_t> lengths;
  for (std::size_t n = 0; n <= 49; ++n) lengths.push_back(n);
  for (const std::size_t n : {63, 64, 65, 127, 200, 511, 513, 1100}) lengths.push_back(n);
  return lengths;
}

/// An array that starts at an odd address of floats, with guards at both ends.
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
  /// 1 or 0.
  Array visible(std::size_t n, std::size_t offset, float share = 0.8F) {
    Array result(n, offset);
    for (std::size_t i = 0; i < n; ++i) result[i] = chance(share) ? 1.0F : 0.0F;
    return result;
  }

 private:
  std::mt19937 engine_;
};

/// Runs a test of every vector backend against the reference at every length and some offsets.
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
