// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input_warnings.h"

#include <ros/console.h>

#include <cmath>
#include <string>

#include "core/camera_doubt.h"

namespace mivo {
namespace {

constexpr double kClockDifference = 10.0;  // s between stamps and clock: more than any latency
constexpr int kFramesOffClock = 10;        // in a row, before the warning
constexpr double kPlausibleDepth[] = {0.1, 30.0};  // m, of the median

}  // namespace

void InputWarnings::lookAtClock(double age) {
  // The first frame may arrive before the first message of a simulated clock.
  const bool is_off = std::abs(age) > kClockDifference && !ros::Time::now().isZero();
  frames_off_clock_ = is_off ? frames_off_clock_ + 1 : 0;
  if (frames_off_clock_ < kFramesOffClock || has_warned_of_clock_) return;
  has_warned_of_clock_ = true;
  ROS_WARN(
      "image stamps are %.0f s %s than the clock; to play a bag, set /use_sim_time to true before "
      "the nodes start, and play it with --clock",
      std::abs(age), age > 0.0 ? "older" : "newer");
}

void InputWarnings::lookAtFrames(const ImagePair& pair, TransformSource& transforms) {
  const std_msgs::Header& color = pair.color->header;
  // In doubles: times that do not belong together may differ by more than a Duration holds.
  lookAtClock(ros::Time::now().toSec() - color.stamp.toSec());
  const std::string& depth_frame = pair.depth->header.frame_id;
  if (parameters_.depth_registered == "auto" && !pair.depth_geometry &&
      depth_frame != color.frame_id && !has_warned_of_frames_) {
    has_warned_of_frames_ = true;
    ROS_WARN(
        "color images have the frame_id %s, depth images %s: depth must be registered to the "
        "color camera (depth_registration of the driver, or depth_image_proc/register)",
        color.frame_id.c_str(), depth_frame.c_str());
  }
  lookAtParent(transforms);
}

void InputWarnings::lookAtParent(TransformSource& transforms) {
  if (!parameters_.publish_tf || !parameters_.guess_frame_id.empty() || has_warned_of_parent_) {
    return;
  }
  const std::string parent = transforms.parentOfBase();
  if (parent.empty() || parent == parameters_.odom_frame) return;
  has_warned_of_parent_ = true;
  ROS_WARN(
      "%s already has the parent %s in tf, and a frame has only one parent: set publish_tf to "
      "false, or guess_frame_id to %s",
      parameters_.base_frame.c_str(), parent.c_str(), parent.c_str());
}

void InputWarnings::lookAtCamera(const Camera& camera) {
  if (has_warned_of_camera_) return;
  for (const std::string& doubt : {doubtOf(camera), describeCoarseness(camera)}) {
    if (doubt.empty()) continue;
    has_warned_of_camera_ = true;
    ROS_WARN("camera_info: %s", doubt.c_str());
  }
}

void InputWarnings::lookAtDepth(const DepthSample& depth) {
  if (depth.median <= 0.0 || has_warned_of_depth_ ||
      (depth.median >= kPlausibleDepth[0] && depth.median <= kPlausibleDepth[1])) {
    return;
  }
  has_warned_of_depth_ = true;
  ROS_WARN(
      "the median depth is %g m: 16UC1 is read as millimeters, 32FC1 as meters; check the unit of "
      "the driver",
      depth.median);
}

}  // namespace mivo
