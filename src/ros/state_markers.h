// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <deque>

#include "mivo/core/camera.h"
#include "mivo/core/tracking_result.h"
#include "ros/node_parameters.h"

namespace mivo {

/// Publishes state_markers: the state and its reason as text above the camera, the camera as a
/// pyramid, and its path, all in the colors of the states. Segments are not connected.
class StateMarkers {
 public:
  StateMarkers(const ros::NodeHandle& private_node, const NodeParameters& parameters);

  /// Adds a frame. Without subscribers only its place on the path is kept, path_length of them.
  /// @param T_odom_world  world of the tracker in the published frame
  void add(const TrackingResult& result, const Camera& camera,
           const Eigen::Isometry3d& T_odom_world, const ros::Time& stamp);

  /// Updates the path after the odometry frame was moved.
  void move(const Eigen::Isometry3d& T_new_old);
  void clear();

 private:
  struct Place {
    Eigen::Vector3d position;  // of the camera
    TrackingState state;
    int segment;
  };

  void publish(const TrackingResult& result, const Camera& camera,
               const Eigen::Isometry3d& T_odom_camera, const ros::Time& stamp);
  visualization_msgs::Marker path(const visualization_msgs::Marker& like) const;

  NodeParameters parameters_;
  ros::Publisher publisher_;
  std::deque<Place> path_;
  TrackingState state_ = TrackingState::kInitializing;  // shown last
  ros::WallTime published_;
};

}  // namespace mivo
