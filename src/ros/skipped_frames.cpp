// SPDX-License-Identifier: BSD-3-Clause
#include "ros/skipped_frames.h"

#include <ros/console.h>

namespace mivo {
namespace {

constexpr double kReminderPeriod = 60.0;  // s
// Reasons may contain numbers and be unlimited: further ones are counted together.
constexpr std::size_t kMaxReasons = 20;
constexpr char kOtherReasons[] = "other reasons";

}  // namespace

bool SkippedFrames::add(const std::string& reason, const ros::WallTime& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool has_room =
      counts_.by_reason.size() < kMaxReasons || counts_.by_reason.count(reason) > 0;
  const std::string key = has_room ? reason : kOtherReasons;
  ++counts_.total;
  counts_.last_reason = reason;
  const std::uint64_t number = ++counts_.by_reason[key];
  ros::WallTime& told = told_[key];
  if ((now - told).toSec() < kReminderPeriod) return false;
  told = now;
  ROS_WARN("frame skipped: %s (%lu so far)", reason.c_str(), static_cast<unsigned long>(number));
  return true;
}

SkipCounts SkippedFrames::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

}  // namespace mivo
