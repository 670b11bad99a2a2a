// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/mi_evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/terms/joint_histogram.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::Random;

constexpr int kBins[] = {4, 8, 16, 32, 64};
constexpr std::size_t kPoints = 1500;
// As a default: the parameter mi_significance.
constexpr double kSignificant = 18.0;

using Pair = std::pair<double, double>;

/// Evidence of so many pairs of gray levels; the range is that of all but one in two hundred.
MiEvidence evidenceOf(const std::function<Pair()>& draw, const IntensityRange& range,
                      std::size_t points, int bins) {
  const Binning binning(range, bins);
  JointHistogram histogram(bins);
  histogram.clear();
  for (std::size_t i = 0; i < points; ++i) {
    const auto [reference, live] = draw();
    histogram.add(binning(static_cast<float>(reference)), binning(static_cast<float>(live)));
  }
  histogram.normalize(points);
  return miEvidence(histogram.mutualInformation(), points, bins);
}

MiEvidence unrelatedUniform(Random& random, std::size_t points, int bins) {
  const auto draw = [&] {
    const double b = random.uniform(0.0, 255.0);
    return Pair(random.uniform(0.0, 255.0), b);
  };
  return evidenceOf(draw, {0.0F, 255.0F}, points, bins);
}

/// Of gray levels 128 +- 40 with a correlation.
MiEvidence correlatedNormal(Random& random, double correlation, std::size_t points, int bins) {
  const auto draw = [&] {
    const double a = random.normal();
    const double b = correlation * a + std::sqrt(1.0 - correlation * correlation) * random.normal();
    return Pair(128.0 + 40.0 * a, 128.0 + 40.0 * b);
  };
  constexpr float kHalfWidth = 40.0F * 2.58F;
  return evidenceOf(draw, {128.0F - kHalfWidth, 128.0F + kHalfWidth}, points, bins);
}

struct Chance {
  double mean = 0.0;
  double most = 0.0;
};

Chance chanceOf(const std::function<MiEvidence()>& trial, int trials) {
  Chance chance;
  for (int i = 0; i < trials; ++i) {
    const double deviations = trial().deviations;
    chance.mean += deviations / trials;
    chance.most = std::max(chance.most, deviations);
  }
  return chance;
}

TEST(MiEvidenceTest, ChanceIsNoEvidenceForAnyNumberOfBinsAndPoints) {
  Random random(1);
  for (const int bins : kBins) {
    for (const std::size_t points : {kPoints, std::size_t{4000}}) {
      const Chance uniform = chanceOf([&] { return unrelatedUniform(random, points, bins); }, 100);
      EXPECT_LT(uniform.mean, 1.0) << bins << " bins, " << points << " points";
      EXPECT_LT(uniform.most, 6.0) << bins << " bins, " << points << " points";
      const Chance normal =
          chanceOf([&] { return correlatedNormal(random, 0.0, points, bins); }, 30);
      EXPECT_LT(normal.mean, 1.0) << bins << " bins, " << points << " points";
      EXPECT_LT(normal.most, 6.0) << bins << " bins, " << points << " points";
    }
  }
}

TEST(MiEvidenceTest, CorrelatedImagesAreSignificantForAnyNumberOfBins) {
  Random random(2);
  for (const int bins : kBins) {
    for (int trial = 0; trial < 5; ++trial) {
      for (const double correlation : {0.8, -0.8}) {
        EXPECT_GT(correlatedNormal(random, correlation, kPoints, bins).deviations, kSignificant)
            << bins;
      }
    }
  }
}

// Of what the windows of the bins leave of it: they have the variance of a third of a bin squared.
TEST(MiEvidenceTest, CorrelationIsThatOfNormalImages) {
  Random random(3);
  for (const int bins : {8, 16, 32}) {
    const double bin = 2.0 * 2.58 / (bins - 1.0);  // in standard deviations
    const double expected = 0.8 / (1.0 + bin * bin / 3.0);
    for (const double correlation : {0.8, -0.8}) {
      const double found = correlatedNormal(random, correlation, 4 * kPoints, bins).correlation;
      EXPECT_NEAR(found, expected, 0.04) << bins;
    }
    EXPECT_LT(correlatedNormal(random, 0.0, 4 * kPoints, bins).correlation, 0.12) << bins;
  }
}

TEST(MiEvidenceTest, MorePointsAreNoMoreIndependent) {
  const double bias_free = 0.5;  // nats, far more than chance
  EXPECT_NEAR(miEvidence(bias_free, 100000, 8).deviations,
              miEvidence(bias_free, 20000, 8).deviations, 1.0);
  EXPECT_NEAR(miEvidence(bias_free, 1500, 8).deviations / miEvidence(bias_free, 750, 8).deviations,
              2.0, 0.05);
}

TEST(MiEvidenceTest, NoPointsAreNoEvidence) {
  const MiEvidence evidence = miEvidence(1.0, 0, 8);
  EXPECT_EQ(evidence.deviations, 0.0);
  EXPECT_EQ(evidence.correlation, 0.0);
}

}  // namespace
}  // namespace mivo
