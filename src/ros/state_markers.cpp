// SPDX-License-Identifier: BSD-3-Clause
#include "ros/state_markers.h"

#include <sstream>
#include <string>

#include "ros/frustum.h"
#include "ros/node_topics.h"
#include "ros/topics.h"

namespace mivo {
namespace {

using visualization_msgs::Marker;

constexpr double kPeriod = 0.2;           // s, between messages while the state stays
constexpr double kStateHeight = 0.16;     // m, of a capital letter
constexpr double kStateAbove = 0.52;      // m, above the camera
constexpr double kReasonHeight = 0.07;    // m
constexpr double kReasonAbove = 0.33;     // m
constexpr std::size_t kReasonWidth = 26;  // characters in a line
constexpr double kFrustumDepth = 0.15;    // m
constexpr double kLineWidth = 0.008;      // m

std_msgs::ColorRGBA rgb(float red, float green, float blue) {
  std_msgs::ColorRGBA color;
  color.r = red;
  color.g = green;
  color.b = blue;
  color.a = 1.0F;
  return color;
}

/// Colors that can be told apart with any color vision (Okabe and Ito).
std_msgs::ColorRGBA colorOf(TrackingState state) {
  switch (state) {
    case TrackingState::kTracking:
      return rgb(0.34F, 0.71F, 0.91F);  // sky blue
    case TrackingState::kDegraded:
      return rgb(0.90F, 0.62F, 0.0F);  // orange
    case TrackingState::kLost:
      return rgb(0.84F, 0.37F, 0.0F);  // vermilion
    case TrackingState::kInitializing:
      break;
  }
  return rgb(0.6F, 0.6F, 0.6F);
}

/// Breaks a text at blanks into lines of at most so many characters, where words are no longer.
std::string inLines(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      lines += line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line;
}

/// Above a camera. An empty text removes what was there.
Marker textMarker(Marker like, const char* ns, const std::string& text,
                  const Eigen::Vector3d& camera, double above, double height) {
  like.ns = ns;
  like.type = Marker::TEXT_VIEW_FACING;
  like.scale.z = height;
  like.text = text;
  like.pose.position = toPoint(camera + above * Eigen::Vector3d::UnitZ());
  if (text.empty()) like.action = Marker::DELETE;
  return like;
}

}  // namespace

StateMarkers::StateMarkers(const ros::NodeHandle& private_node, const NodeParameters& parameters)
    : parameters_(parameters) {
  ros::NodeHandle handle(private_node);
  publisher_ = handle.advertise<visualization_msgs::MarkerArray>(
      topicBeside(private_node, topics::kStateMarkers), 1, true);
}

void StateMarkers::add(const TrackingResult& result, const Camera& camera,
                       const Eigen::Isometry3d& T_odom_world, const ros::Time& stamp) {
  const Eigen::Isometry3d T_odom_camera = T_odom_world * result.T_odom_camera;
  if (result.isMeasured()) {
    if (path_.size() >= static_cast<std::size_t>(parameters_.path_length)) path_.pop_front();
    path_.push_back({T_odom_camera.translation(), result.state, result.segment});
  }
  const ros::WallTime now = ros::WallTime::now();
  if (publisher_.getNumSubscribers() == 0) return;
  if (result.state == state_ && (now - published_).toSec() < kPeriod) return;
  publish(result, camera, T_odom_camera, stamp);
  state_ = result.state;
  published_ = now;
}

void StateMarkers::publish(const TrackingResult& result, const Camera& camera,
                           const Eigen::Isometry3d& T_odom_camera, const ros::Time& stamp) {
  Marker marker;
  marker.header.stamp = stamp;
  marker.header.frame_id = parameters_.odom_frame;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.color = colorOf(result.state);
  visualization_msgs::MarkerArray message;

  const Eigen::Vector3d camera_position = T_odom_camera.translation();
  message.markers.push_back(textMarker(marker, "state", toString(result.state), camera_position,
                                       kStateAbove, kStateHeight));
  const std::string reason =
      result.reason == TrackingReason::kNone ? "" : inLines(describeReason(result), kReasonWidth);
  message.markers.push_back(
      textMarker(marker, "reason", reason, camera_position, kReasonAbove, kReasonHeight));

  Marker frustum = marker;
  frustum.ns = "camera";
  frustum.type = Marker::LINE_LIST;
  frustum.scale.x = kLineWidth;
  addFrustum(camera, T_odom_camera, kFrustumDepth, frustum.points);
  message.markers.push_back(frustum);

  message.markers.push_back(path(marker));
  publisher_.publish(message);
}

Marker StateMarkers::path(const Marker& like) const {
  Marker path = like;
  path.ns = "path";
  path.type = Marker::LINE_LIST;
  path.scale.x = kLineWidth;
  for (std::size_t i = 1; i < path_.size(); ++i) {
    if (path_[i].segment != path_[i - 1].segment) continue;
    path.points.push_back(toPoint(path_[i - 1].position));
    path.points.push_back(toPoint(path_[i].position));
    path.colors.insert(path.colors.end(), 2, colorOf(path_[i].state));
  }
  if (path.points.empty()) path.action = Marker::DELETE;
  return path;
}

void StateMarkers::move(const Eigen::Isometry3d& T_new_old) {
  for (Place& place : path_) place.position = T_new_old * place.position;
  published_ = ros::WallTime();  // shown anew with the next frame
}

void StateMarkers::clear() {
  path_.clear();
  published_ = ros::WallTime();
  visualization_msgs::MarkerArray nothing;
  nothing.markers.resize(1);
  nothing.markers[0].header.frame_id = parameters_.odom_frame;
  nothing.markers[0].action = Marker::DELETEALL;
  publisher_.publish(nothing);
}

}  // namespace mivo
