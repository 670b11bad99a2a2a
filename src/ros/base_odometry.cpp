// SPDX-License-Identifier: BSD-3-Clause
#include "ros/base_odometry.h"

#include <cmath>

#include "ros/pose_conversion.h"

namespace mivo {
namespace {

// Variance of components fixed by two_d_mode: 1 mm, 1 mrad.
constexpr double kPlaneVariance = 1e-6;

/// Rotates both halves of a six-vector.
Matrix6 rotation(const Eigen::Matrix3d& R) {
  Matrix6 result = Matrix6::Zero();
  result.topLeftCorner<3, 3>() = R;
  result.bottomRightCorner<3, 3>() = R;
  return result;
}

/// Keeps x, y and yaw of a covariance.
Matrix6 covarianceInPlane(const Matrix6& covariance) {
  constexpr int kKept[] = {0, 1, 5};
  Matrix6 result = Matrix6::Identity() * kPlaneVariance;
  for (const int row : kKept) {
    for (const int column : kKept) result(row, column) = covariance(row, column);
  }
  return result;
}

template <typename Array>
void write(const Matrix6& covariance, Array& array) {
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      array[static_cast<std::size_t>(6 * row + column)] = covariance(row, column);
    }
  }
}

}  // namespace

BaseOdometry toBase(const TrackingResult& result, const Matrix6& camera_twist_covariance,
                    const Eigen::Isometry3d& T_odom_world, const Eigen::Isometry3d& T_base_camera) {
  BaseOdometry odometry;
  odometry.T_odom_base = T_odom_world * result.T_odom_camera * T_base_camera.inverse();
  // T retract(e) seen from the base is T_odom_base (T_base_camera retract(e) T_camera_base): to
  // first order the adjoint carries e into the axes of the base, and with the lever arm to its
  // origin.
  const Matrix6 base_from_camera = adjoint(T_base_camera);
  const Matrix6 odom_from_camera = rotation(odometry.T_odom_base.linear()) * base_from_camera;
  odometry.pose_covariance =
      boundedCovariance(odom_from_camera * result.covariance * odom_from_camera.transpose());
  odometry.twist = base_from_camera * result.velocity;
  odometry.twist_covariance =
      boundedCovariance(base_from_camera * camera_twist_covariance * base_from_camera.transpose());
  return odometry;
}

BaseOdometry inPlane(const BaseOdometry& odometry) {
  BaseOdometry flat;
  const Eigen::Matrix3d R = odometry.T_odom_base.linear();
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  flat.T_odom_base.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  flat.T_odom_base.translation().head<2>() = odometry.T_odom_base.translation().head<2>();
  flat.pose_covariance = covarianceInPlane(odometry.pose_covariance);
  flat.twist.head<2>() = odometry.twist.head<2>();
  flat.twist(5) = odometry.twist(5);
  flat.twist_covariance = covarianceInPlane(odometry.twist_covariance);
  return flat;
}

nav_msgs::Odometry toMessage(const BaseOdometry& odometry) {
  nav_msgs::Odometry message;
  message.pose.pose = toPose(odometry.T_odom_base);
  write(odometry.pose_covariance, message.pose.covariance);
  message.twist.twist.linear.x = odometry.twist(0);
  message.twist.twist.linear.y = odometry.twist(1);
  message.twist.twist.linear.z = odometry.twist(2);
  message.twist.twist.angular.x = odometry.twist(3);
  message.twist.twist.angular.y = odometry.twist(4);
  message.twist.twist.angular.z = odometry.twist(5);
  write(odometry.twist_covariance, message.twist.covariance);
  return message;
}

}  // namespace mivo
