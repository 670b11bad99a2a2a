// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <string>

#include "mivo/core/tracking_result.h"

namespace mivo {

/// Logs changes of the tracking state, and changes of its reason at most every few seconds.
class StateLog {
 public:
  /// Returns whether something was logged.
  bool add(const TrackingResult& result, const ros::WallTime& now);

 private:
  TrackingState state_ = TrackingState::kInitializing;
  std::string reason_;  // logged last
  ros::WallTime told_;
};

}  // namespace mivo
