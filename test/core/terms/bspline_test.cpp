// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/bspline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/reference_mutual_information.h"

namespace mivo {
namespace {

const float kFractions[] = {0.0F, 1e-6F, 0.1F, 0.25F, 0.5F, 0.77F, 0.999F};

double sum(const SplineWeights& w) {
  double total = 0.0;
  for (const float value : w) total += static_cast<double>(value);
  return total;
}

TEST(BsplineTest, WeightsAreTheCubicBsplineAtTheDistanceOfEachBin) {
  for (const float t : kFractions) {
    const SplineWeights weights = splineWeights(t);
    for (int bin = 0; bin < kSplineSupport; ++bin) {
      const double distance = static_cast<double>(t) - (bin - 1);
      EXPECT_NEAR(weights[static_cast<std::size_t>(bin)], testing::cubicBspline(distance), 2e-7)
          << t << ' ' << bin;
    }
  }
}

TEST(BsplineTest, WeightsSumToOneAndTheirDerivativesToZero) {
  for (const float t : kFractions) {
    EXPECT_NEAR(sum(splineWeights(t)), 1.0, 1e-6);
    EXPECT_NEAR(sum(splineDerivatives(t)), 0.0, 1e-6);
    EXPECT_NEAR(sum(splineSecondDerivatives(t)), 0.0, 1e-6);
    for (const float weight : splineWeights(t)) EXPECT_GE(weight, 0.0F);
  }
}

TEST(BsplineTest, DerivativesAreThoseOfTheKernel) {
  constexpr double kStep = 1e-3;
  for (const float t : kFractions) {
    const SplineWeights first = splineDerivatives(t);
    const SplineWeights second = splineSecondDerivatives(t);
    for (int bin = 0; bin < kSplineSupport; ++bin) {
      const double s = static_cast<double>(t) - (bin - 1);
      const double before = testing::cubicBspline(s - kStep);
      const double here = testing::cubicBspline(s);
      const double after = testing::cubicBspline(s + kStep);
      const auto i = static_cast<std::size_t>(bin);
      EXPECT_NEAR(first[i], (after - before) / (2.0 * kStep), 2e-6);
      // The third derivative jumps at whole numbers, where the difference is only of first order.
      EXPECT_NEAR(second[i], (after - 2.0 * here + before) / (kStep * kStep), 2e-3);
    }
  }
}

TEST(BsplineTest, TheKernelIsSmoothFromOneBinToTheNext) {
  for (std::size_t bin = 0; bin + 1 < kSplineSupport; ++bin) {
    EXPECT_NEAR(splineWeights(1.0F)[bin + 1], splineWeights(0.0F)[bin], 1e-6);
    EXPECT_NEAR(splineDerivatives(1.0F)[bin + 1], splineDerivatives(0.0F)[bin], 1e-6);
    EXPECT_NEAR(splineSecondDerivatives(1.0F)[bin + 1], splineSecondDerivatives(0.0F)[bin], 1e-6);
  }
}

}  // namespace
}  // namespace mivo
