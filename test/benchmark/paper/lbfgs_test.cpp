// SPDX-License-Identifier: BSD-3-Clause
#include "lbfgs.h"

#include <gtest/gtest.h>

#include "mivo/core/se3.h"

namespace mivo {
namespace {

/// A smooth cost of the pose alone, half the squared distance of four points from where the
/// optimal pose maps them, with its exact gradient with respect to T retract(d)^-1.
class PointDistance : public CostTerm {
 public:
  explicit PointDistance(const Eigen::Isometry3d& optimum) : optimum_(optimum) {}

  double evaluate(const Eigen::Isometry3d& T) override {
    T_ = T;
    double cost = 0.0;
    for (const Eigen::Vector3d& X : points_) cost += 0.5 * (T * X - optimum_ * X).squaredNorm();
    return cost;
  }

  QuadraticModel linearize(int) override {
    QuadraticModel model;
    model.cost = evaluate(T_);
    for (const Eigen::Vector3d& X : points_) {
      // T retract(d)^-1 X = T (X - v - w x X) to first order.
      const Eigen::Vector3d g = -(T_.linear().transpose() * (T_ * X - optimum_ * X));
      model.gradient.head<3>() += g;
      model.gradient.tail<3>() += X.cross(g);
    }
    return model;
  }

 private:
  Eigen::Isometry3d optimum_;
  Eigen::Isometry3d T_;
  const Eigen::Vector3d points_[4] = {
      {1.0, 0.0, 2.0}, {-1.0, 0.5, 1.0}, {0.0, -1.0, 3.0}, {0.5, 1.0, 1.5}};
};

Eigen::Isometry3d pose(double scale) {
  Vector6 twist;
  twist << 0.3, -0.2, 0.1, 0.2, 0.3, -0.25;
  return expSe3(scale * twist);
}

class LbfgsTest : public ::testing::TestWithParam<GradientSource> {};

TEST_P(LbfgsTest, FindsTheMinimumOfASmoothCost) {
  PointDistance term(pose(1.0));
  Parameters parameters;
  parameters.alignment.min_cost_change = 0.0;
  const LbfgsResult result = minimizeByLbfgs(term, pose(-0.5), 2.0, GetParam(), parameters);
  EXPECT_TRUE(result.T_live_ref.isApprox(pose(1.0), 1e-5)) << result.cost;
  EXPECT_LT(result.cost, 1e-9);
  EXPECT_GT(result.iterations, 1);
  EXPECT_GE(result.evaluations, result.gradients);
}

INSTANTIATE_TEST_SUITE_P(Gradients, LbfgsTest,
                         ::testing::Values(GradientSource::kTerm, GradientSource::kDifferences));

// With a wrong gradient the line search would fail early: the two implementations take the same
// steps.
TEST(Lbfgs, TakesTheSameStepsWithEitherGradient) {
  PointDistance term(pose(1.0));
  Parameters parameters;
  parameters.alignment.min_cost_change = 1e-6;
  const LbfgsResult exact =
      minimizeByLbfgs(term, pose(-0.5), 2.0, GradientSource::kTerm, parameters);
  const LbfgsResult differences =
      minimizeByLbfgs(term, pose(-0.5), 2.0, GradientSource::kDifferences, parameters);
  EXPECT_EQ(differences.iterations, exact.iterations);
  EXPECT_TRUE(differences.T_live_ref.isApprox(exact.T_live_ref, 1e-6));
}

}  // namespace
}  // namespace mivo
