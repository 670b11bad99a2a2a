// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_transport/publisher.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <vector>

#include "mivo/core/odometry.h"
#include "ros/image_message.h"
#include "ros/node_parameters.h"

namespace mivo {

/// Publishes keyframe_cloud, keyframes, reference/image and residual/image. Topics without
/// subscribers are not computed.
class DisplayPublisher {
 public:
  DisplayPublisher(const ros::NodeHandle& private_node, const NodeParameters& parameters);

  /// @param keyframe      number of the current keyframe
  /// @param T_odom_world  world of the tracker in the published frame
  /// @param color         of the frame
  void publish(const Odometry& odometry, int keyframe, const Eigen::Isometry3d& T_odom_world,
               const ImageMessageConstPtr& color);

  /// Updates the keyframes after the odometry frame was moved.
  void move(const Eigen::Isometry3d& T_new_old);
  void clear();

 private:
  void publishCloud(const Odometry& odometry, const Eigen::Isometry3d& T_odom_keyframe,
                    const ros::Time& stamp);
  void publishMarkers(const ros::Time& stamp);
  void publishImage(image_transport::Publisher& publisher, const cv::Mat& image,
                    const std_msgs::Header& header);

  NodeParameters parameters_;
  ros::Publisher cloud_;
  ros::Publisher markers_;
  image_transport::Publisher reference_;
  image_transport::Publisher residual_;
  std::vector<Eigen::Isometry3d> keyframes_;  // T_odom_keyframe
  ImageMessageConstPtr keyframe_color_;       // of the last one
  Camera camera_;
  int last_keyframe_ = 0;   // seen
  int cloud_keyframe_ = 0;  // shown
  int markers_keyframe_ = 0;
  int reference_keyframe_ = 0;
};

}  // namespace mivo
