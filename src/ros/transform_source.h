// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace mivo {

/// tf lookups of the odometry, with a listener thread of its own.
class TransformSource {
 public:
  TransformSource(const ros::NodeHandle& node, const std::string& base_frame,
                  const std::string& guess_frame);

  /// T_base_camera without waiting: at the given time, or the latest one, or the last known one;
  /// empty if there was none yet. Warns every ten seconds while it is missing.
  std::optional<Eigen::Isometry3d> baseCamera(const std::string& camera_frame,
                                              const ros::Time& stamp);

  /// Pose of the base in the frame of another odometry, T_guess_base; empty when tf does not have
  /// it within `timeout`.
  std::optional<Eigen::Isometry3d> guessBase(const ros::Time& stamp,
                                             const ros::WallDuration& timeout);

  /// Pose of a frame in another, the latest that is known; nothing when tf does not know it.
  std::optional<Eigen::Isometry3d> between(const std::string& target, const std::string& source);

  /// Parent of the base in tf; empty when it has none.
  std::string parentOfBase();

 private:
  std::string base_frame_;
  std::string guess_frame_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  std::optional<Eigen::Isometry3d> T_base_camera_;  // last good one
  std::string camera_frame_;                        // of it
};

}  // namespace mivo
