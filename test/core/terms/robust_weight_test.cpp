// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/robust_weight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

const RobustWeight kKinds[] = {RobustWeight::kNone, RobustWeight::kHuber, RobustWeight::kTukey,
                               RobustWeight::kStudentT};

TEST(RobustWeightTest, TheWeightIsTheSlopeOfTheLossOverTheResidual) {
  constexpr float kStep = 1e-2F;
  for (const RobustWeight kind : kKinds) {
    for (const float u : {-6.0F, -2.0F, -1.0F, 0.3F, 1.1F, 1.6F, 3.0F, 4.5F, 9.0F}) {
      const double slope = (static_cast<double>(robustLoss(kind, u + kStep).loss) -
                            static_cast<double>(robustLoss(kind, u - kStep).loss)) /
                           (2.0 * static_cast<double>(kStep));
      EXPECT_NEAR(robustLoss(kind, u).weight * u, slope, 5e-4)
          << static_cast<int>(kind) << ' ' << u;
    }
  }
}

TEST(RobustWeightTest, SmallResidualsAreSquared) {
  EXPECT_EQ(robustLoss(RobustWeight::kNone, 3.0F).loss, 4.5F);
  for (const RobustWeight kind : kKinds) {
    EXPECT_EQ(robustLoss(kind, 0.0F).loss, 0.0F);
    const float curvature = robustLoss(kind, 0.0F).weight;
    EXPECT_NEAR(curvature, kind == RobustWeight::kStudentT ? 1.2F : 1.0F, 1e-6);
    EXPECT_NEAR(robustLoss(kind, 0.01F).loss, 0.5F * curvature * 1e-4F, 5e-7);
  }
}

TEST(RobustWeightTest, ShapesAreThoseOfTheTable) {
  for (const float u : {0.5F, 2.0F, 4.0F, 8.0F}) {
    EXPECT_FLOAT_EQ(robustLoss(RobustWeight::kHuber, u).weight, std::min(1.0F, 1.345F / u));
    const float rest = 1.0F - (u / 4.685F) * (u / 4.685F);
    EXPECT_NEAR(robustLoss(RobustWeight::kTukey, u).weight, u < 4.685F ? rest * rest : 0.0F, 1e-6);
    EXPECT_FLOAT_EQ(robustLoss(RobustWeight::kStudentT, u).weight, 6.0F / (5.0F + u * u));
  }
}

TEST(RobustWeightTest, MeanCurvatureIsThatOfGaussianResiduals) {
  for (const RobustWeight kind : kKinds) {
    constexpr int kSteps = 4000;
    double weights = 0.0;
    double curvatures = 0.0;
    const auto influence = [&](double u) {
      return static_cast<double>(robustLoss(kind, static_cast<float>(u)).weight) * u;
    };
    for (int i = 0; i < kSteps; ++i) {
      const double low = -8.0 + 16.0 * i / kSteps;
      const double high = -8.0 + 16.0 * (i + 1) / kSteps;
      const double middle = 0.5 * (low + high);
      const double density = std::exp(-0.5 * middle * middle);
      weights += density * influence(middle) / middle * (high - low);
      curvatures += density * (influence(high) - influence(low));
    }
    EXPECT_NEAR(gaussianCurvature(kind), curvatures / weights, 2e-3) << static_cast<int>(kind);
  }
}

TEST(RobustWeightTest, LossesAreEvenAndNeverFall) {
  for (const RobustWeight kind : kKinds) {
    float before = -1.0F;
    for (float u = 0.0F; u < 20.0F; u += 0.05F) {
      const RobustLoss loss = robustLoss(kind, u);
      EXPECT_GE(loss.loss, before);
      EXPECT_EQ(loss.loss, robustLoss(kind, -u).loss);
      EXPECT_EQ(loss.weight, robustLoss(kind, -u).weight);
      EXPECT_GE(loss.weight, 0.0F);
      before = loss.loss;
    }
  }
}

}  // namespace
}  // namespace mivo
