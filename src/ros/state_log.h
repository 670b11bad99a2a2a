// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <string>

#include "mivo/core/tracking_result.h"

namespace mivo {

/// Tells in the log when the state of tracking changes, and when its reason does, though that not
/// more often than every few seconds.
class StateLog {
 public:
  /// Returns whether there was something to tell.
  bool add(const TrackingResult& result, const ros::WallTime& now);

 private:
  TrackingState state_ = TrackingState::kInitialising;
  std::string reason_;  // told last
  ros::WallTime told_;
};

}  // namespace mivo
