// SPDX-License-Identifier: BSD-3-Clause
#include "ros/depth_geometry.h"

#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <array>

#include "ros/bag_topics.h"
#include "ros/leading_slash.h"
#include "ros/pose_conversion.h"
#include "ros/topics.h"

namespace mivo {
namespace {

constexpr char kTransforms[] = "/tf";

void add(const RecordedMessage& message, tf2::BufferCore& tree) {
  if (!message.is<tf2_msgs::TFMessage>()) return;
  const auto transforms = message.read<tf2_msgs::TFMessage>();
  for (geometry_msgs::TransformStamped transform : transforms->transforms) {
    transform.header.frame_id = withoutSlash(transform.header.frame_id);
    transform.child_frame_id = withoutSlash(transform.child_frame_id);
    if (transform.header.frame_id == transform.child_frame_id) continue;
    tree.setTransform(transform, "bag", true);
  }
}

}  // namespace

bool isUnregistered(const std::string& color_frame, const std::string& depth_frame,
                    const std::string& depth_topic) {
  constexpr std::array<const char*, 4> kRegistered = {"registered", "aligned", "to_rgb",
                                                      "to_color"};
  return withoutSlash(color_frame) != withoutSlash(depth_frame) && !depth_frame.empty() &&
         !color_frame.empty() &&
         std::none_of(kRegistered.begin(), kRegistered.end(), [&](const char* word) {
           return depth_topic.find(word) != std::string::npos;
         });
}

std::string cameraInfoBeside(const std::string& image_topic) {
  const std::string base = withoutTransport(image_topic);
  return base.substr(0, base.rfind('/') + 1) + "camera_info";
}

std::optional<Eigen::Isometry3d> findTransform(const Recording& recording,
                                               const std::string& target,
                                               const std::string& source) {
  const std::string to = withoutSlash(target);
  const std::string from = withoutSlash(source);
  tf2::BufferCore tree;
  for (const char* topic : {topics::kStaticTransforms, kTransforms}) {
    for (const RecordedMessage& message : recording.messages({topic, withoutSlash(topic)})) {
      if (topic == kTransforms && tree.canTransform(to, from, ros::Time(0))) break;
      add(message, tree);
    }
  }
  if (!tree.canTransform(to, from, ros::Time(0))) return std::nullopt;
  return toIsometry(tree.lookupTransform(to, from, ros::Time(0)).transform);
}

std::string describeMissingGeometry(const std::string& color_frame, const std::string& depth_frame,
                                    const std::string& info_topic, bool has_calibration) {
  return "depth (in the frame " + depth_frame + ") is not registered to color (in " + color_frame +
         "), and " +
         (has_calibration ? "tf has no transform between the two"
                          : "there is no calibration of depth on " + info_topic);
}

}  // namespace mivo
