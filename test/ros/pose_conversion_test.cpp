// SPDX-License-Identifier: BSD-3-Clause
#include "ros/pose_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ros/expect_error.h"

namespace mivo {
namespace {

geometry_msgs::Pose poseOf(double x, double y, double z, double w) {
  geometry_msgs::Pose pose;
  pose.position.x = 1.0;
  pose.orientation.x = x;
  pose.orientation.y = y;
  pose.orientation.z = z;
  pose.orientation.w = w;
  return pose;
}

TEST(PoseConversionTest, QuaternionsOfAnyLengthAreNormalized) {
  for (const double length : {1e-3, 0.5, 1.0, 2.0, 1e3}) {
    const Eigen::Isometry3d T = toIsometry(poseOf(0.0, 0.0, length, length));
    EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
    EXPECT_EQ(T.translation(), Eigen::Vector3d::UnitX());
  }
}

TEST(PoseConversionTest, WhatIsNoRotationIsRefused) {
  EXPECT_ERROR(toIsometry(poseOf(0.0, 0.0, 0.0, 0.0)), "length 0.000000: it says no rotation");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_ERROR(toIsometry(poseOf(nan, 0.0, 0.0, 1.0)), "it says no rotation");
  geometry_msgs::Pose pose = poseOf(0.0, 0.0, 0.0, 1.0);
  pose.position.y = nan;
  EXPECT_ERROR(toIsometry(pose), "not finite");
}

}  // namespace
}  // namespace mivo
