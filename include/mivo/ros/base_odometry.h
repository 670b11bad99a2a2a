// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>

#include <Eigen/Geometry>

#include "mivo/core/se3.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// Bounds of the variances that leave mivo: filters divide by them, and overflow on "unknown".
constexpr double kMinVariance = 1e-12;
constexpr double kMaxVariance = 1e6;
/// Variance of what is not known at all: m2, rad2, or per second squared.
constexpr double kUnknownVariance = 1e4;

/// Motion of the robot's base, from that of the camera.
struct BaseOdometry {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();

  /// Of T_odom_base, as nav_msgs/Odometry wants it: error of the base's position in the axes of
  /// odom (m), then the error's rotation about the fixed axes of odom (rad).
  Matrix6 pose_covariance = Matrix6::Identity() * kUnknownVariance;

  Vector6 twist = Vector6::Zero();  ///< of the base in its own axes: m/s, rad/s
  Matrix6 twist_covariance = Matrix6::Identity() * kUnknownVariance;
};

/// @param result             of the frame; its world is the odometry's own
/// @param camera_twist_covariance  of result.velocity, in the axes of the camera
/// @param T_odom_world       world of the tracker in the published frame
/// @param T_base_camera      optical frame on the robot
BaseOdometry toBase(const TrackingResult& result, const Matrix6& camera_twist_covariance,
                    const Eigen::Isometry3d& T_odom_world, const Eigen::Isometry3d& T_base_camera);

/// Covariance of the velocity between two poses of given covariances, `seconds` apart. The two
/// frames are aligned with the keyframe independently of each other, so that their errors add up.
Matrix6 twistCovariance(const Matrix6& before, const Matrix6& now, double seconds);

/// The nearest covariance that is symmetric, positive definite and within the bounds above; one of
/// unknown variance when a number is not finite.
Matrix6 boundedCovariance(const Matrix6& covariance);

/// Motion in the plane z = 0 of odom: x, y and yaw are kept. What the plane fixes has a small
/// variance.
BaseOdometry inPlane(const BaseOdometry& odometry);

/// Header and child_frame_id are left empty.
nav_msgs::Odometry toMessage(const BaseOdometry& odometry);

}  // namespace mivo
