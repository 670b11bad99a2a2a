// SPDX-License-Identifier: BSD-3-Clause
#include "ros/transform_source.h"

#include <ros/console.h>

#include "ros/leading_slash.h"
#include "ros/pose_conversion.h"

namespace mivo {
namespace {

constexpr double kReminderPeriod = 10.0;  // s
constexpr double kPollPeriod = 0.001;     // s
constexpr double kIdentityTolerance = 1e-6;

/// An optical frame looks along z, a body frame along x: equal axes mean a missing rotation.
void warnOfMissingRotation(const Eigen::Isometry3d& T_base_camera, const std::string& base,
                           const std::string& camera) {
  if (!T_base_camera.linear().isIdentity(kIdentityTolerance)) return;
  ROS_WARN(
      "%s and the camera's optical frame %s have the same axes, but an optical frame has z "
      "forward and a base frame x forward (REP 103): the odometry will be rotated; check the "
      "transform",
      base.c_str(), camera.c_str());
}

}  // namespace

TransformSource::TransformSource(const ros::NodeHandle& node, const std::string& base_frame,
                                 const std::string& guess_frame)
    : base_frame_(base_frame), guess_frame_(guess_frame), listener_(buffer_, node, true) {}

std::optional<Eigen::Isometry3d> TransformSource::baseCamera(const std::string& camera_frame,
                                                             const ros::Time& stamp) {
  const std::string camera = withoutSlash(camera_frame);
  if (camera == base_frame_) return Eigen::Isometry3d::Identity();
  if (camera != camera_frame_) T_base_camera_.reset();
  std::string fault;
  const ros::Time time = buffer_.canTransform(base_frame_, camera, stamp) ? stamp : ros::Time(0);
  try {
    const bool first = !T_base_camera_;
    T_base_camera_ = toIsometry(buffer_.lookupTransform(base_frame_, camera, time).transform);
    camera_frame_ = camera;
    if (first) warnOfMissingRotation(*T_base_camera_, base_frame_, camera);
  } catch (const std::exception& error) {
    fault = error.what();
  }
  if (!T_base_camera_) {
    ROS_WARN_THROTTLE(
        kReminderPeriod,
        "no odometry is published until tf has the transform from %s to the camera's frame %s: %s "
        "(parameter base_frame)",
        base_frame_.c_str(), camera.empty() ? "(empty)" : camera.c_str(), fault.c_str());
  }
  return T_base_camera_;
}

std::optional<Eigen::Isometry3d> TransformSource::guessBase(const ros::Time& stamp,
                                                            const ros::WallDuration& timeout) {
  // The wait is in wall time: a simulated clock may stand still.
  const ros::WallTime deadline = ros::WallTime::now() + timeout;
  while (!buffer_.canTransform(guess_frame_, base_frame_, stamp)) {
    if (ros::WallTime::now() >= deadline) return std::nullopt;
    ros::WallDuration(kPollPeriod).sleep();
  }
  try {
    return toIsometry(buffer_.lookupTransform(guess_frame_, base_frame_, stamp).transform);
  } catch (const std::exception&) {
    return std::nullopt;  // removed from the buffer between the two calls
  }
}

std::optional<Eigen::Isometry3d> TransformSource::between(const std::string& target,
                                                          const std::string& source) {
  try {
    return toIsometry(
        buffer_.lookupTransform(withoutSlash(target), withoutSlash(source), ros::Time(0))
            .transform);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string TransformSource::parentOfBase() {
  std::string parent;
  return buffer_._getParent(base_frame_, ros::Time(0), parent) ? parent : std::string();
}

}  // namespace mivo
