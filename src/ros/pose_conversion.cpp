// SPDX-License-Identifier: BSD-3-Clause
#include "ros/pose_conversion.h"

#include <cmath>
#include <string>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// Of a quaternion: a smaller one is no rotation but a field that was never filled in.
constexpr double kMinNorm = 1e-6;

template <typename Vector, typename Quaternion>
void write(const Eigen::Isometry3d& T, Vector& position, Quaternion& orientation) {
  Eigen::Quaterniond q(T.linear());
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  position.x = T.translation().x();
  position.y = T.translation().y();
  position.z = T.translation().z();
  orientation.x = q.x();
  orientation.y = q.y();
  orientation.z = q.z();
  orientation.w = q.w();
}

template <typename Vector, typename Quaternion>
Eigen::Isometry3d read(const Vector& position, const Quaternion& orientation) {
  const Eigen::Vector3d t(position.x, position.y, position.z);
  const Eigen::Quaterniond q(orientation.w, orientation.x, orientation.y, orientation.z);
  if (!t.allFinite()) throw Error("the position of the pose is not finite");
  if (!std::isfinite(q.norm()) || q.norm() < kMinNorm) {
    throw Error("the quaternion of the pose has the length " + std::to_string(q.norm()) +
                ": it says no rotation");
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() = t;
  return T;
}

}  // namespace

geometry_msgs::Pose toPose(const Eigen::Isometry3d& T) {
  geometry_msgs::Pose pose;
  write(T, pose.position, pose.orientation);
  return pose;
}

geometry_msgs::Transform toTransform(const Eigen::Isometry3d& T) {
  geometry_msgs::Transform transform;
  write(T, transform.translation, transform.rotation);
  return transform;
}

Eigen::Isometry3d toIsometry(const geometry_msgs::Pose& pose) {
  return read(pose.position, pose.orientation);
}

Eigen::Isometry3d toIsometry(const geometry_msgs::Transform& transform) {
  return read(transform.translation, transform.rotation);
}

}  // namespace mivo
