// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/pixel_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mivo {
namespace {

TEST(GaussianTable, HoldsTheQuantilesOfTheNormalDistribution) {
  const float* table = gaussianTable();
  // Values of the distribution function from tables: Phi(1.959964) = 0.975, Phi(1) = 0.841345.
  EXPECT_NEAR(table[static_cast<int>(0.975 * 65536)], 1.959964, 2e-3);
  EXPECT_NEAR(table[static_cast<int>(0.841345 * 65536)], 1.0, 1e-3);
  EXPECT_NEAR(table[65535], 4.33, 0.02);  // Phi(4.33) = 1 - 0.5 / 65536
  for (int k = 0; k < 65536; ++k) {
    ASSERT_EQ(table[k], -table[65535 - k]);
    if (k > 0) {
      ASSERT_GT(table[k], table[k - 1]);
    }
  }
}

TEST(GaussianTable, HasUnitVarianceAndTheKurtosisOfANormal) {
  const float* table = gaussianTable();
  double second = 0.0;
  double fourth = 0.0;
  for (int k = 0; k < 65536; ++k) {
    const double square = static_cast<double>(table[k]) * table[k];
    second += square / 65536;
    fourth += square * square / 65536;
  }
  EXPECT_NEAR(second, 1.0, 1e-3);
  EXPECT_NEAR(fourth, 3.0, 2e-2);
}

// Neighboring pixels and the channels of a pixel must be uncorrelated.
TEST(HashOf, GivesUncorrelatedNoiseToNeighbors) {
  constexpr int kSize = 256;
  double across = 0.0;
  double down = 0.0;
  double channels = 0.0;
  for (std::uint64_t y = 0; y < kSize; ++y) {
    for (std::uint64_t x = 0; x < kSize; ++x) {
      const std::uint64_t here = hashOf(7, y, x);
      across += gaussianFrom(here) * gaussianFrom(hashOf(7, y, x + 1));
      down += gaussianFrom(here) * gaussianFrom(hashOf(7, y + 1, x));
      channels += gaussianFrom(here) * gaussianFrom(here >> 16);
    }
  }
  // The mean of n independent products has the standard deviation 1 / sqrt(n).
  const double bound = 5.0 / kSize;
  EXPECT_LT(std::abs(across) / (kSize * kSize), bound);
  EXPECT_LT(std::abs(down) / (kSize * kSize), bound);
  EXPECT_LT(std::abs(channels) / (kSize * kSize), bound);
}

TEST(UniformFrom, CoversTheUnitInterval) {
  double sum = 0.0;
  constexpr int kDraws = 20000;
  for (std::uint64_t k = 0; k < kDraws; ++k) {
    const float u = uniformFrom(hashOf(3, k));
    ASSERT_GE(u, 0.0F);
    ASSERT_LT(u, 1.0F);
    sum += u;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kDraws));
  EXPECT_EQ(uniformFrom(0), 0.0F);
  EXPECT_LT(uniformFrom(~std::uint64_t{0}), 1.0F);
}

}  // namespace
}  // namespace mivo
