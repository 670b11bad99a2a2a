// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/absolute_trajectory_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mivo/core/se3.h"
#include "support/error_text.h"

namespace mivo {
namespace {

Trajectory circle(int count) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    StampedPose pose;
    pose.stamp = 0.1 * i;
    const double angle = 2.0 * M_PI * i / count;
    pose.pose.translation() << std::cos(angle), std::sin(angle), 0.0;
    trajectory.push_back(pose);
  }
  return trajectory;
}

TEST(AbsoluteTrajectoryErrorTest, MovedTrajectoryHasNone) {
  const Trajectory truth = circle(36);
  Trajectory estimate = truth;
  Vector6 twist;
  twist << 3.0, 2.0, 1.0, 0.3, -0.2, 2.0;
  const Eigen::Isometry3d T = expSe3(twist);
  for (StampedPose& pose : estimate) pose.pose = T.inverse() * pose.pose;
  const AbsoluteTrajectoryError error = absoluteTrajectoryError(matchPoses(truth, estimate, 0.02));
  EXPECT_TRUE(error.T_truth_estimate.isApprox(T, 1e-12));
  ASSERT_EQ(error.errors().size(), 36U);
  for (const double value : error.errors()) EXPECT_NEAR(value, 0.0, 1e-12);
}

TEST(AbsoluteTrajectoryErrorTest, WrongRadiusIsSeenAtEachPose) {
  const Trajectory truth = circle(36);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) pose.pose.translation() *= 1.1;  // no scale is corrected
  for (const double value : absoluteTrajectoryError(matchPoses(truth, estimate, 0.02)).errors()) {
    EXPECT_NEAR(value, 0.1, 1e-12);
  }
}

TEST(AbsoluteTrajectoryErrorTest, FreeScaleTakesTheWrongRadiusAway) {
  const Trajectory truth = circle(36);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) {
    pose.pose.translation() = 1.25 * pose.pose.translation() + Eigen::Vector3d(1.0, 2.0, 3.0);
  }
  const AbsoluteTrajectoryError error =
      absoluteTrajectoryError(matchPoses(truth, estimate, 0.02), AlignmentScale::kFree);
  EXPECT_NEAR(error.scale, 0.8, 1e-12);
  for (const double value : error.errors()) EXPECT_NEAR(value, 0.0, 1e-12);
  for (const double value : error.rotations) EXPECT_NEAR(value, 0.0, 1e-7);
}

TEST(AbsoluteTrajectoryErrorTest, ErrorsByAxisAndByAngle) {
  const Trajectory truth = circle(36);
  Trajectory estimate = truth;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    // Alternating signs, so that alignment cannot reduce the error.
    estimate[i].pose.translation().z() += i % 2 == 0 ? 0.05 : -0.05;
    estimate[i].pose.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()));
  }
  const AbsoluteTrajectoryError error = absoluteTrajectoryError(matchPoses(truth, estimate, 0.02));
  for (const Eigen::Vector3d& difference : error.differences) {
    EXPECT_NEAR(difference.x(), 0.0, 1e-3);
    EXPECT_NEAR(std::abs(difference.z()), 0.05, 1e-3);
  }
  for (const double value : error.rotations) EXPECT_NEAR(value, 0.02, 1e-3);
}

TEST(AbsoluteTrajectoryErrorTest, OnlyPosesWithTruthNearbyCount) {
  const Trajectory truth = circle(36);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) pose.stamp += 0.015;
  estimate[3].stamp += 0.03;
  EXPECT_EQ(absoluteTrajectoryError(matchPoses(truth, estimate, 0.02)).errors().size(), 35U);
}

TEST(AbsoluteTrajectoryErrorTest, TooFewCommonPosesAreAnError) {
  const Trajectory truth = circle(36);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) pose.stamp += 100.0;
  EXPECT_EQ(errorText([&] { matchPoses(truth, estimate, 0.02); }).find("only 0 of 36 poses"), 0U);
}

}  // namespace
}  // namespace mivo
