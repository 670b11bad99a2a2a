// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>

#include <Eigen/Geometry>

#include "mivo/core/se3.h"
#include "mivo/core/tracking_result.h"
#include "session/twist_covariance.h"

namespace mivo {

/// Motion of the robot's base, from that of the camera.
struct BaseOdometry {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();

  /// Of T_odom_base, as defined by nav_msgs/Odometry: error of the base's position in the axes of
  /// odom (m), then error of its rotation about the fixed axes of odom (rad).
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

/// Motion in the plane z = 0 of odom: x, y and yaw are kept. Components fixed by the plane have a
/// small variance.
BaseOdometry inPlane(const BaseOdometry& odometry);

/// Header and child_frame_id are left empty.
nav_msgs::Odometry toMessage(const BaseOdometry& odometry);

}  // namespace mivo
