// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input_warnings.h"

#include <ros/console.h>

#include <cmath>
#include <string>

#include "core/camera_doubt.h"
#include "ros/clock_fault.h"
#include "ros/leading_slash.h"
#include "session/median.h"

namespace mivo {
namespace {

constexpr double kClockDifference = 10.0;  // s between stamps and clock: more than any latency
constexpr int kFramesOffClock = 10;        // in a row, before the warning
constexpr std::size_t kFirstFrames = 15;   // half a second of an Xtion: enough to judge by

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
  lookAtOffset(pair.depth->header.stamp.toSec() - color.stamp.toSec());
  const std::string& depth_frame = pair.depth->header.frame_id;
  const bool is_other = withoutSlash(depth_frame) != withoutSlash(color.frame_id);
  if (parameters_.depth_registered == "auto" && !pair.depth_geometry && is_other &&
      !has_warned_of_frames_) {
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

void InputWarnings::lookAtDepth(const Frame& frame, const DepthParameters& parameters) {
  if (depth_.frames() == kFirstFrames) return;
  depth_.add(frame);
  if (depth_.frames() < kFirstFrames) return;
  const std::string fault =
      depth_.findFault(parameters, kDepthUnitOfMessages, DepthAccount::Expected::kAnything);
  if (!fault.empty()) ROS_WARN_STREAM(fault);
}

void InputWarnings::lookAtOffset(double offset) {
  if (pair_offsets_.size() == kFirstFrames) return;
  pair_offsets_.push_back(offset);
  if (pair_offsets_.size() < kFirstFrames) return;
  const std::string text = describePairOffset(medianOf(pair_offsets_));
  if (!text.empty()) ROS_WARN_STREAM(text);
}

}  // namespace mivo
