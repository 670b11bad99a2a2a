// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/motion_prior_term.h"

#include <gtest/gtest.h>

#include "core/alignment/minimize.h"
#include "core/alignment/pose_covariance.h"
#include "support/numeric_derivative.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::Random;

const Matrix6 kCovariance = diagonalCovariance(0.004, 0.03);

Eigen::Isometry3d moved(const Eigen::Isometry3d& T_live_ref, const Vector6& d) {
  return T_live_ref * retract(d).inverse();
}

TEST(MotionPriorTermTest, CostIsHalfTheSquaredDistanceInTheLiveCamerasAxes) {
  const Eigen::Isometry3d predicted = Random(1).pose(0.4, 0.3);
  MotionPriorTerm prior(predicted, kCovariance, 7.0);
  EXPECT_NEAR(prior.evaluate(predicted), 0.0, 1e-12);
  // Two deviations along an axis, one about another.
  const Vector6 off = 2.0 * 0.004 * Vector6::Unit(1) + 0.03 * Vector6::Unit(3);
  EXPECT_NEAR(prior.evaluate(retract(off).inverse() * predicted), 7.0 * 0.5 * (4.0 + 1.0), 1e-9);
}

TEST(MotionPriorTermTest, GradientAndHessianAreThoseOfTheCost) {
  Random random(2);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Isometry3d predicted = random.pose(0.4, 0.3);
    const Eigen::Isometry3d at = random.pose(0.02, 0.02) * predicted;
    MotionPriorTerm prior(predicted, kCovariance, 3.0);
    const auto cost = [&](const Vector6& d) { return prior.evaluate(moved(at, d)); };
    const Vector6 gradient = testing::numericGradient<6>(cost, Vector6::Zero(), 1e-6);
    const double cost_there = prior.evaluate(at);
    const QuadraticModel model = prior.linearize(0);
    EXPECT_NEAR(model.cost, cost_there, 1e-12);
    EXPECT_LT(testing::relativeError(model.gradient, gradient), 1e-5);
    // The Gauss-Newton approximation is exact at zero error.
    const auto there = [&](const Vector6& d) { return prior.evaluate(moved(predicted, d)); };
    const Matrix6 hessian = testing::numericHessian<6>(there, Vector6::Zero(), 1e-4);
    prior.evaluate(predicted);
    EXPECT_LT(testing::relativeError(prior.linearize(0).hessian, hessian), 1e-4);
  }
}

TEST(MotionPriorTermTest, LeftToItselfTheCameraKeepsItsVelocity) {
  const Eigen::Isometry3d predicted = Random(4).pose(0.3, 0.2);
  MotionPriorTerm prior(predicted, kCovariance, 1.0);
  Parameters parameters;
  parameters.alignment.min_step_pixels = 1e-4;
  const Matrix6 pixel_motion = 1e5 * Matrix6::Identity();
  const Minimum minimum = minimize({&prior}, Random(5).pose(0.01, 0.01) * predicted, 1.0,
                                   pixel_motion, parameters, 1.0, 0.0);
  EXPECT_LT(localCoordinates(minimum.T_live_ref * predicted.inverse()).norm(), 1e-5);
}

}  // namespace
}  // namespace mivo
