// SPDX-License-Identifier: BSD-3-Clause
#include "ros/base_odometry.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "ros/expect_error.h"
#include "ros/pose_conversion.h"

namespace mivo {
namespace {

Eigen::Isometry3d makePose(double x, double y, double z, const Eigen::Vector3d& rotation) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << x, y, z;
  T.linear() = expSo3(rotation);
  return T;
}

/// A camera in front of and above the base's origin, looking forward.
Eigen::Isometry3d cameraOnBase() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T.translation() << 0.3, 0.05, 0.4;
  return T;
}

double smallestEigenvalue(const Matrix6& matrix) {
  return Eigen::SelfAdjointEigenSolver<Matrix6>(matrix).eigenvalues().minCoeff();
}

TEST(BaseOdometryTest, FirstFramePutsTheBaseAtTheOriginOfOdom) {
  // The tracker's world is the first camera pose; odom is the first pose of the base.
  const BaseOdometry odometry =
      toBase(TrackingResult(), Matrix6::Identity(), cameraOnBase(), cameraOnBase());
  EXPECT_TRUE(odometry.T_odom_base.matrix().isIdentity(1e-15));
}

TEST(BaseOdometryTest, CameraForwardIsBaseForward) {
  TrackingResult result;
  result.T_odom_camera.translation().z() = 1.0;
  const BaseOdometry odometry = toBase(result, Matrix6::Identity(), cameraOnBase(), cameraOnBase());
  EXPECT_TRUE(odometry.T_odom_base.translation().isApprox(Eigen::Vector3d(1, 0, 0), 1e-15));
}

TEST(BaseOdometryTest, TwistIsThatOfTheBaseWithTheLeverArm) {
  // The base turns in place about its z axis with 1 rad/s: a camera 0.3 m in front of it and 0.05 m
  // to the left moves with (-0.05, 0.3, 0) m/s in the base's axes.
  const Eigen::Vector3d base_rate(0, 0, 1);
  const Eigen::Matrix3d R_base_camera = cameraOnBase().linear();
  TrackingResult result;
  result.velocity.head<3>() =
      R_base_camera.transpose() * base_rate.cross(cameraOnBase().translation());
  result.velocity.tail<3>() = R_base_camera.transpose() * base_rate;
  const BaseOdometry odometry = toBase(result, Matrix6::Identity(), cameraOnBase(), cameraOnBase());
  EXPECT_TRUE(odometry.twist.head<3>().isZero(1e-15)) << odometry.twist.transpose();
  EXPECT_TRUE(odometry.twist.tail<3>().isApprox(base_rate, 1e-15));
}

TEST(BaseOdometryTest, PoseCovarianceIsThatOfSampledErrors) {
  // Compared with samples: random errors in the camera's axes, transformed by the exact poses.
  TrackingResult result;
  result.T_odom_camera = makePose(0.5, -0.2, 1.5, {0.3, -0.8, 0.4});
  const Matrix6 random = (Matrix6() << 1, .2, 0, .1, 0, .3, 0, 2, .4, 0, 0, .1, .5, 0, 1, .2, 0, 0,
                          0, .3, 0, 1, .1, 0, .2, 0, .1, 0, 1, .4, 0, .1, 0, .2, 0, 2)
                             .finished();
  const Matrix6 root = 1e-4 * random;
  result.covariance = root * root.transpose();
  const BaseOdometry odometry = toBase(result, Matrix6::Identity(), cameraOnBase(), cameraOnBase());

  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  Matrix6 sampled = Matrix6::Zero();
  constexpr int kSamples = 40000;
  for (int i = 0; i < kSamples; ++i) {
    Vector6 unit;
    for (int k = 0; k < 6; ++k) unit(k) = normal(engine);
    const Eigen::Isometry3d T_true =
        cameraOnBase() * result.T_odom_camera * retract(root * unit) * cameraOnBase().inverse();
    Vector6 error;
    error << T_true.translation() - odometry.T_odom_base.translation(),
        logSo3(T_true.linear() * odometry.T_odom_base.linear().transpose());
    sampled += error * error.transpose() / kSamples;
  }
  // Standard error of a sampled covariance: sqrt(2 / n) of the variances, here 0.7 %; five of them.
  EXPECT_LT((sampled - odometry.pose_covariance).norm(),
            5 * std::sqrt(2.0 / kSamples) * odometry.pose_covariance.norm());
  EXPECT_GT(smallestEigenvalue(odometry.pose_covariance), 0.0);
}

TEST(BaseOdometryTest, TwistCovarianceIsThatOfSampledErrors) {
  const Matrix6 camera = (Vector6() << 1, 4, 9, 16, 25, 36).finished().asDiagonal();
  const BaseOdometry odometry = toBase(TrackingResult(), camera, cameraOnBase(), cameraOnBase());
  // Turning about the camera's y axis (down) moves the base's origin 0.3 m behind it sideways,
  // along the camera's x axis, which is the base's -y: 1 + 25 * 0.3^2 from there, and 0.4 m below
  // from roll.
  EXPECT_NEAR(1.0 + 25.0 * 0.3 * 0.3 + 36.0 * 0.4 * 0.4, odometry.twist_covariance(1, 1), 1e-9);
  EXPECT_NEAR(25.0, odometry.twist_covariance(5, 5), 1e-12);  // yaw of the base
}

TEST(InPlaneTest, KeepsPositionYawAndTheirCovariance) {
  BaseOdometry odometry;
  odometry.T_odom_base = makePose(1.0, 2.0, 0.3, {0, 0, 0});
  odometry.T_odom_base.linear() = (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()) *
                                   Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitX()))
                                      .toRotationMatrix();
  odometry.twist << 1, 2, 3, 4, 5, 6;
  odometry.pose_covariance = (Vector6() << 1, 2, 3, 4, 5, 6).finished().asDiagonal();
  odometry.pose_covariance(0, 5) = odometry.pose_covariance(5, 0) = 0.5;
  const BaseOdometry flat = inPlane(odometry);
  EXPECT_TRUE(flat.T_odom_base.translation().isApprox(Eigen::Vector3d(1, 2, 0)));
  EXPECT_TRUE(logSo3(flat.T_odom_base.linear()).isApprox(Eigen::Vector3d(0, 0, 0.7), 1e-12));
  EXPECT_EQ((Vector6() << 1, 2, 0, 0, 0, 6).finished(), flat.twist);
  EXPECT_EQ(0.5, flat.pose_covariance(0, 5));
  EXPECT_EQ(6.0, flat.pose_covariance(5, 5));
  EXPECT_LT(flat.pose_covariance(2, 2), 1e-5);
  EXPECT_GT(smallestEigenvalue(flat.pose_covariance), 0.0);
}

TEST(ToMessageTest, NumbersStandWhereTheMessageWantsThem) {
  BaseOdometry odometry;
  odometry.T_odom_base = makePose(1, 2, 3, {0, 0, 0});
  odometry.T_odom_base.linear() =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  odometry.twist << 1, 2, 3, 4, 5, 6;
  odometry.pose_covariance(1, 4) = 42.0;
  odometry.twist_covariance(5, 0) = 43.0;
  const nav_msgs::Odometry message = toMessage(odometry);
  EXPECT_EQ(3.0, message.pose.pose.position.z);
  EXPECT_NEAR(std::sqrt(0.5), message.pose.pose.orientation.z, 1e-15);
  EXPECT_NEAR(std::sqrt(0.5), message.pose.pose.orientation.w, 1e-15);
  EXPECT_EQ(2.0, message.twist.twist.linear.y);
  EXPECT_EQ(6.0, message.twist.twist.angular.z);
  EXPECT_EQ(42.0, message.pose.covariance[1 * 6 + 4]);
  EXPECT_EQ(43.0, message.twist.covariance[5 * 6 + 0]);
}

TEST(PoseConversionTest, RoundTripAndRefusals) {
  const Eigen::Isometry3d T = makePose(0.1, -2, 3, {1, -2, 0.5});
  EXPECT_TRUE(toIsometry(toPose(T)).isApprox(T, 1e-14));
  EXPECT_TRUE(toIsometry(toTransform(T)).isApprox(T, 1e-14));
  geometry_msgs::Pose pose;  // a quaternion of zeros
  EXPECT_ERROR(toIsometry(pose), "quaternion");
  pose.orientation.w = 1.04;
  EXPECT_TRUE(toIsometry(pose).isApprox(Eigen::Isometry3d::Identity()));
  pose.orientation.w = 1.0;
  pose.position.x = std::numeric_limits<double>::infinity();
  EXPECT_ERROR(toIsometry(pose), "not finite");
}

}  // namespace
}  // namespace mivo
