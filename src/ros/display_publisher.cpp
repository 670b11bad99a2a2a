// SPDX-License-Identifier: BSD-3-Clause
#include "ros/display_publisher.h"

#include <cv_bridge/cv_bridge.h>
#include <image_transport/image_transport.h>
#include <sensor_msgs/image_encodings.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/frustum.h"
#include "ros/keyframe_cloud.h"
#include "ros/node_topics.h"
#include "ros/topics.h"

namespace mivo {
namespace {

constexpr double kFrustumDepth = 0.1;  // m, of the pyramid that stands for a keyframe
constexpr double kLineWidth = 0.004;   // m
constexpr char kMarkerNamespace[] = "keyframes";

}  // namespace

DisplayPublisher::DisplayPublisher(const ros::NodeHandle& private_node,
                                   const NodeParameters& parameters)
    : parameters_(parameters) {
  ros::NodeHandle handle(private_node);
  const auto beside = [&](const char* topic) { return topicBeside(private_node, topic); };
  image_transport::ImageTransport transport(handle);
  cloud_ = handle.advertise<sensor_msgs::PointCloud2>(beside(topics::kKeyframeCloud), 1, true);
  markers_ =
      handle.advertise<visualization_msgs::MarkerArray>(beside(topics::kKeyframeMarkers), 1, true);
  reference_ = transport.advertise(beside(topics::kReferenceImage), 1, true);
  residual_ = transport.advertise(beside(topics::kResidualImage), 1);
}

void DisplayPublisher::publish(const Odometry& odometry, int keyframe,
                               const Eigen::Isometry3d& T_odom_world,
                               const ImageMessageConstPtr& color) {
  if (!odometry.hasKeyframe()) return;
  const Eigen::Isometry3d T_odom_keyframe = T_odom_world * odometry.keyframePose();
  camera_ = odometry.camera();
  const std_msgs::Header& header = color->header;
  if (keyframe != last_keyframe_) {
    last_keyframe_ = keyframe;
    keyframe_color_ = color;
    if (keyframes_.size() >= static_cast<std::size_t>(parameters_.path_length)) {
      keyframes_.erase(keyframes_.begin());
    }
    keyframes_.push_back(T_odom_keyframe);
  }
  if (cloud_keyframe_ != keyframe && cloud_.getNumSubscribers() > 0) {
    publishCloud(odometry, T_odom_keyframe, header.stamp);
    cloud_keyframe_ = keyframe;
  }
  if (markers_keyframe_ != keyframe && markers_.getNumSubscribers() > 0) {
    publishMarkers(header.stamp);
    markers_keyframe_ = keyframe;
  }
  if (reference_keyframe_ != keyframe && reference_.getNumSubscribers() > 0) {
    publishImage(reference_, odometry.keyframeImage(), header);
    reference_keyframe_ = keyframe;
  }
  if (residual_.getNumSubscribers() > 0) publishImage(residual_, odometry.residualImage(), header);
}

void DisplayPublisher::publishCloud(const Odometry& odometry,
                                    const Eigen::Isometry3d& T_odom_keyframe,
                                    const ros::Time& stamp) {
  const sensor_msgs::PointCloud2Ptr message =
      toCloud(odometry.keyframeCloud(), T_odom_keyframe, keyframe_color_->toColorImage());
  message->header.stamp = stamp;
  message->header.frame_id = parameters_.odom_frame;
  cloud_.publish(message);
}

void DisplayPublisher::publishMarkers(const ros::Time& stamp) {
  visualization_msgs::Marker marker;
  marker.header.stamp = stamp;
  marker.header.frame_id = parameters_.odom_frame;
  marker.ns = kMarkerNamespace;
  marker.type = visualization_msgs::Marker::LINE_LIST;
  marker.action =
      keyframes_.empty() ? visualization_msgs::Marker::DELETE : visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = kLineWidth;
  marker.color.r = 0.80F;  // purple: none of the states' colors
  marker.color.g = 0.47F;
  marker.color.b = 0.65F;
  marker.color.a = 1.0F;
  for (const Eigen::Isometry3d& T : keyframes_)
    addFrustum(camera_, T, kFrustumDepth, marker.points);
  visualization_msgs::MarkerArray message;
  message.markers.push_back(marker);
  markers_.publish(message);
}

void DisplayPublisher::publishImage(image_transport::Publisher& publisher, const cv::Mat& image,
                                    const std_msgs::Header& header) {
  if (image.empty()) return;
  publisher.publish(
      cv_bridge::CvImage(header, sensor_msgs::image_encodings::MONO8, image).toImageMsg());
}

void DisplayPublisher::move(const Eigen::Isometry3d& T_new_old) {
  for (Eigen::Isometry3d& T : keyframes_) T = T_new_old * T;
  cloud_keyframe_ = markers_keyframe_ = 0;  // shown anew with the next frame
}

void DisplayPublisher::clear() {
  keyframes_.clear();
  keyframe_color_.reset();
  last_keyframe_ = cloud_keyframe_ = markers_keyframe_ = 0;
  publishMarkers(ros::Time::now());
}

}  // namespace mivo
