// SPDX-License-Identifier: BSD-3-Clause
#include "ros/odometry_publisher.h"

#include <algorithm>
#include <cstdint>

#include "ros/node_topics.h"
#include "ros/pose_conversion.h"
#include "ros/topics.h"

namespace mivo {
namespace {

constexpr std::uint32_t kOdometryQueue = 50;
constexpr std::uint32_t kStatusQueue = 50;
// A long path is a big message: it is sent less often than it grows.
constexpr double kPathPeriod = 0.2;  // s
constexpr int kPathBlocks = 10;      // a full path loses its oldest block at once

}  // namespace

OdometryPublisher::OdometryPublisher(const ros::NodeHandle& private_node,
                                     const NodeParameters& parameters)
    : parameters_(parameters) {
  ros::NodeHandle handle(private_node);
  const auto beside = [&](const char* topic) { return topicBeside(private_node, topic); };
  odometry_ = handle.advertise<nav_msgs::Odometry>(beside(topics::kOdometry), kOdometryQueue);
  path_publisher_ = handle.advertise<nav_msgs::Path>(beside(topics::kPath), 1, true);
  status_ = handle.advertise<TrackingStatus>(beside(topics::kStatus), kStatusQueue);
  path_.header.frame_id = parameters.odom_frame;
}

void OdometryPublisher::publish(const BaseOdometry& odometry, const ros::Time& stamp,
                                const std::optional<Eigen::Isometry3d>& T_guess_base) {
  nav_msgs::Odometry message = toMessage(odometry);
  message.header.stamp = stamp;
  message.header.frame_id = parameters_.odom_frame;
  message.child_frame_id = parameters_.base_frame;
  odometry_.publish(message);
  if (parameters_.publish_tf) publishTransform(odometry.T_odom_base, stamp, T_guess_base);
  addToPath(odometry, stamp);
}

void OdometryPublisher::publishTransform(const Eigen::Isometry3d& T_odom_base,
                                         const ros::Time& stamp,
                                         const std::optional<Eigen::Isometry3d>& T_guess_base) {
  const bool above_guess = !parameters_.guess_frame_id.empty();
  if (above_guess && !T_guess_base) return;  // odom -> base would give the base a second parent
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = parameters_.odom_frame;
  transform.child_frame_id = above_guess ? parameters_.guess_frame_id : parameters_.base_frame;
  transform.transform =
      toTransform(above_guess ? T_odom_base * T_guess_base->inverse() : T_odom_base);
  broadcaster_.sendTransform(transform);
}

void OdometryPublisher::addToPath(const BaseOdometry& odometry, const ros::Time& stamp) {
  if (path_.poses.size() >= static_cast<std::size_t>(parameters_.path_length)) {
    const std::ptrdiff_t block = std::max(1, parameters_.path_length / kPathBlocks);
    path_.poses.erase(path_.poses.begin(), path_.poses.begin() + block);
  }
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = stamp;
  pose.header.frame_id = parameters_.odom_frame;
  pose.pose = toPose(odometry.T_odom_base);
  path_.poses.push_back(pose);
  path_.header.stamp = stamp;
  const ros::WallTime now = ros::WallTime::now();
  if (path_publisher_.getNumSubscribers() > 0 && (now - last_path_).toSec() >= kPathPeriod) {
    path_publisher_.publish(path_);
    last_path_ = now;
  }
}

void OdometryPublisher::movePath(const Eigen::Isometry3d& T_new_old) {
  for (geometry_msgs::PoseStamped& pose : path_.poses) {
    pose.pose = toPose(T_new_old * toIsometry(pose.pose));
  }
  path_publisher_.publish(path_);
}

void OdometryPublisher::clearPath() {
  path_.poses.clear();
  path_publisher_.publish(path_);
}

}  // namespace mivo
