// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_frames.h"

#include <ros/time.h>

#include <string>

namespace mivo {
namespace {

// m, to the left of the link's middle; negative: to the right.
constexpr double kDepthLens = -0.02;
constexpr double kColorLens = -0.045;

geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child,
                                          double y, bool to_optical) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time::now();
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.y = y;
  // Optical frames (REP 103) have z forward and x right where bodies have x forward and y left.
  transform.transform.rotation.x = to_optical ? -0.5 : 0.0;
  transform.transform.rotation.y = to_optical ? 0.5 : 0.0;
  transform.transform.rotation.z = to_optical ? -0.5 : 0.0;
  transform.transform.rotation.w = to_optical ? 0.5 : 1.0;
  return transform;
}

}  // namespace

std::vector<geometry_msgs::TransformStamped> cameraTransforms(const CameraParameters& parameters) {
  return {transform(parameters.linkFrame(), parameters.rgbFrame(), kColorLens, false),
          transform(parameters.rgbFrame(), parameters.rgbOpticalFrame(), 0.0, true),
          transform(parameters.linkFrame(), parameters.depthFrame(), kDepthLens, false),
          transform(parameters.depthFrame(), parameters.depthOpticalFrame(), 0.0, true)};
}

}  // namespace mivo
