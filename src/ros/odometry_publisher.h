// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mivo/TrackingStatus.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>

#include "ros/base_odometry.h"
#include "ros/node_parameters.h"

namespace mivo {

/// Publishes odom, tf, path and status.
class OdometryPublisher {
 public:
  OdometryPublisher(const ros::NodeHandle& private_node, const NodeParameters& parameters);

  /// @param T_guess_base  pose of the base in guess_frame_id at the stamp: then tf gets odom_frame
  /// ->
  ///                      guess_frame_id, for the base has its parent already
  void publish(const BaseOdometry& odometry, const ros::Time& stamp,
               const std::optional<Eigen::Isometry3d>& T_guess_base);

  void publish(const TrackingStatus& status) { status_.publish(status); }

  /// Transforms the path after the odometry frame was moved.
  void movePath(const Eigen::Isometry3d& T_new_old);
  void clearPath();

 private:
  void addToPath(const BaseOdometry& odometry, const ros::Time& stamp);
  void publishTransform(const Eigen::Isometry3d& T_odom_base, const ros::Time& stamp,
                        const std::optional<Eigen::Isometry3d>& T_guess_base);

  NodeParameters parameters_;
  ros::Publisher odometry_;
  ros::Publisher path_publisher_;
  ros::Publisher status_;
  tf2_ros::TransformBroadcaster broadcaster_;
  nav_msgs::Path path_;
  ros::WallTime last_path_;
};

}  // namespace mivo
