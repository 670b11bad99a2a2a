// SPDX-License-Identifier: BSD-3-Clause
#include "ros/state_log.h"

#include <ros/console.h>

namespace mivo {
namespace {

constexpr double kReasonPeriod = 5.0;  // s

}  // namespace

bool StateLog::add(const TrackingResult& result, const ros::WallTime& now) {
  const std::string reason = describeReason(result);
  const bool is_other_reason = reason != reason_ && (now - told_).toSec() >= kReasonPeriod;
  if (result.state == state_ && !is_other_reason) return false;
  state_ = result.state;
  reason_ = reason;
  told_ = now;
  if (result.state == TrackingState::kTracking) {
    ROS_INFO("tracking, keyframe %d", result.keyframes);
  } else {
    ROS_WARN("%s: %s", toString(result.state), reason.c_str());
  }
  return true;
}

}  // namespace mivo
