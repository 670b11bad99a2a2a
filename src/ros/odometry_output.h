// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <optional>

#include "ros/display_publisher.h"
#include "ros/node_parameters.h"
#include "ros/odometry_publisher.h"
#include "ros/state_markers.h"
#include "session/tracking_session.h"

namespace mivo {

/// Publishes odom, tf, path and display topics, all in the odometry frame. It is the pose of the
/// base at the first frame, unless it was moved.
class OdometryOutput {
 public:
  OdometryOutput(const ros::NodeHandle& private_node, const NodeParameters& parameters);

  /// Publishes the pose of the session's last frame, if it was measured or publish_when_lost is
  /// set.
  /// @param T_base_camera  at the frame
  /// @param T_guess_base   see OdometryPublisher::publish
  void publishOdometry(const TrackingSession& session, const ros::Time& stamp,
                       const Eigen::Isometry3d& T_base_camera,
                       const std::optional<Eigen::Isometry3d>& T_guess_base);

  /// After publishOdometry. @param color of the frame
  void publishDisplay(const TrackingSession& session, const ImageMessageConstPtr& color);

  void publishStatus(const TrackingStatus& status) { publisher_.publish(status); }

  /// Moves the odometry frame so that the base is at the given pose. Throws Error before the first
  /// pose.
  void setPose(const Eigen::Isometry3d& T_odom_base, const TrackingSession& session);

  /// The pose of the base at the next frame becomes the odometry frame.
  void reset();

 private:
  NodeParameters parameters_;
  OdometryPublisher publisher_;
  DisplayPublisher display_;
  StateMarkers markers_;
  std::optional<Eigen::Isometry3d> T_odom_world_;  // known once tf has the transform to the camera
  Eigen::Isometry3d T_base_camera_ = Eigen::Isometry3d::Identity();  // of the last frame
};

}  // namespace mivo
