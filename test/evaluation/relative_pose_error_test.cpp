// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/relative_pose_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mivo/core/se3.h"

namespace mivo {
namespace {

constexpr double kPeriod = 0.1;  // s
constexpr double kLimit = 0.02;  // s

Vector6 velocityOf(const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
  Vector6 twist;
  twist << v, w;
  return twist;
}

/// Screw motion of constant velocity, `count` poses.
Trajectory screw(const Vector6& velocity, int count) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    trajectory.push_back({10.0 + kPeriod * i, expSe3(velocity * (kPeriod * i))});
  }
  return trajectory;
}

TEST(RelativePoseErrorTest, ScaleErrorOfAStraightPathIsADrift) {
  const Trajectory truth = screw(velocityOf({0.5, 0.0, 0.0}, {0, 0, 0}), 31);
  const Trajectory estimate = screw(velocityOf({0.55, 0.0, 0.0}, {0, 0, 0}), 31);
  const auto errors = relativePoseErrors(truth, estimate, 1.0, kLimit);
  // Partners 10 later: of 31 poses number 19 is the last whose partner is not the last pose.
  ASSERT_EQ(errors.size(), 20U);
  for (const RelativePoseError& error : errors) {
    EXPECT_NEAR(error.translation, 0.05, 1e-12);
    EXPECT_NEAR(error.rotation, 0.0, 1e-12);
  }
  EXPECT_EQ(errors.front().stamp, 10.0);
}

TEST(RelativePoseErrorTest, TurnRateErrorIsARotation) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, -2.0) / 3.0;
  const Trajectory truth = screw(velocityOf({0, 0, 0}, 0.4 * axis), 21);
  const Trajectory estimate = screw(velocityOf({0, 0, 0}, 0.3 * axis), 21);
  for (const RelativePoseError& error : relativePoseErrors(truth, estimate, 0.5, kLimit)) {
    EXPECT_NEAR(error.rotation, 0.05, 1e-12);
    EXPECT_NEAR(error.translation, 0.0, 1e-12);
  }
}

TEST(RelativePoseErrorTest, TranslationIsThatOfTheFirstPoseSeenFromTheSecond) {
  // The camera moves by m and turns by a right angle; the estimate lacks the rotation. Relative to
  // the second pose the first one is at -R^-1 m in the truth and at -m in the estimate, sqrt(2) |m|
  // apart. Relative to the first pose the second one is at m in both.
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.translation() << 1.0, 0.0, 0.0;
  Eigen::Isometry3d straight = turned;
  turned.linear() = expSo3({0.0, 0.0, M_PI / 2.0});
  const Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  const Trajectory truth = {{0.0, start}, {1.0, turned}, {2.0, turned}};
  const Trajectory estimate = {{0.0, start}, {1.0, straight}, {2.0, straight}};
  const auto errors = relativePoseErrors(truth, estimate, 1.0, kLimit);
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NEAR(errors[0].translation, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(errors[0].rotation, M_PI / 2.0, 1e-12);
}

TEST(RelativePoseErrorTest, DoesNotDependOnTheWorlds) {
  const Trajectory truth = screw(velocityOf({0.5, 0.1, 0.0}, {0.1, 0.2, 0.3}), 25);
  Trajectory estimate = screw(velocityOf({0.45, 0.12, 0.0}, {0.1, 0.25, 0.3}), 25);
  const auto before = relativePoseErrors(truth, estimate, 1.0, kLimit);
  const Eigen::Isometry3d world = expSe3(velocityOf({1, 2, 3}, {1, 0, -1}));
  for (StampedPose& pose : estimate) pose.pose = world * pose.pose;
  const auto after = relativePoseErrors(truth, estimate, 1.0, kLimit);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(before[i].translation, after[i].translation, 1e-12);
    EXPECT_NEAR(before[i].rotation, after[i].rotation, 1e-12);
  }
}

TEST(RelativePoseErrorTest, PairsWithoutTruthNearbyAreDropped) {
  Trajectory truth = screw(velocityOf({0.5, 0.0, 0.0}, {0, 0, 0}), 31);
  const Trajectory estimate = truth;
  truth.erase(truth.begin() + 5);
  // Pose 5 has no truth: as a first pose (5, 15) is gone; as a second pose none ends there.
  EXPECT_EQ(relativePoseErrors(truth, estimate, 1.0, kLimit).size(), 19U);
  // With a larger limit the neighbor is used, one period off.
  const auto errors = relativePoseErrors(truth, estimate, 1.0, 0.15);
  ASSERT_EQ(errors.size(), 20U);
  EXPECT_NEAR(errors[5].translation, 0.5 * kPeriod, 1e-12);
  EXPECT_TRUE(relativePoseErrors({}, estimate, 1.0, kLimit).empty());
}

TEST(RelativePoseErrorTest, DeltaBeyondTheEndHasNoPairs) {
  const Trajectory truth = screw(velocityOf({0.5, 0.0, 0.0}, {0, 0, 0}), 10);
  EXPECT_TRUE(relativePoseErrors(truth, truth, 5.0, kLimit).empty());
}

TEST(RelativePoseErrorTest, APoseIsNotComparedWithItself) {
  const Trajectory truth = screw(velocityOf({0.5, 0.0, 0.0}, {0, 0, 0}), 31);
  EXPECT_TRUE(relativePoseErrors(truth, truth, 0.01, kLimit).empty());
  // Two poses with the same true pose give none, either.
  EXPECT_TRUE(relativePoseErrors({truth[15]}, truth, 1.0, 10.0).empty());
}

TEST(RelativePoseErrorTest, StepsGoFromMatchedPoseToMatchedPose) {
  const Trajectory truth = screw(velocityOf({1.0, 0.0, 0.0}, {0, 0, 0}), 31);
  Trajectory estimate = screw(velocityOf({1.1, 0.0, 0.0}, {0, 0, 0}), 31);
  estimate.erase(estimate.begin() + 10, estimate.begin() + 14);
  const auto errors = stepErrors(matchPoses(truth, estimate, kLimit));
  ASSERT_EQ(errors.size(), estimate.size() - 1);
  EXPECT_NEAR(errors[0].translation, 0.01, 1e-12);
  EXPECT_NEAR(errors[9].translation, 0.05, 1e-12);  // over the gap of 5 periods
}

TEST(RelativePoseErrorTest, PathPairsAreMetersOfTheTruePathApart) {
  // 0.1 m a step: marks at 0.5 m, 1.0 m, ..., 3.0 m, and pairs from each to the next.
  const Trajectory truth = screw(velocityOf({1.0, 0.0, 0.0}, {0, 0, 0}), 31);
  const Trajectory estimate = screw(velocityOf({1.1, 0.0, 0.0}, {0, 0, 0}), 31);
  const MatchedPoses poses = matchPoses(truth, estimate, kLimit);
  const auto errors = pathErrors(poses, 0.5 - 1e-9);
  ASSERT_EQ(errors.size(), 5U);
  for (const RelativePoseError& error : errors) EXPECT_NEAR(error.translation, 0.05, 1e-12);
  EXPECT_NEAR(errors[0].stamp, 10.5, 1e-12);
  EXPECT_TRUE(pathErrors(poses, 2.0).empty());  // a second mark is not reached
}

}  // namespace
}  // namespace mivo
