// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>
#include <ros/time.h>

#include <atomic>
#include <exception>

namespace mivo {

/// Runs what ROS, or a thread of ours, calls: an exception that came out of it would end the
/// process, and with it all nodelets of the manager. It is logged, at most every five seconds.
template <typename Call>
void guardedCall(const char* name, const Call& call) {
  constexpr double kLogPeriod = 5.0;  // s
  try {
    call();
  } catch (const std::exception& error) {
    // In wall time: a simulated clock may stand still.
    static std::atomic<double> next{0.0};
    double due = next;
    const double now = ros::WallTime::now().toSec();
    if (now >= due && next.compare_exchange_strong(due, now + kLogPeriod)) {
      ROS_ERROR("%s failed: %s", name, error.what());
    }
  }
}

}  // namespace mivo
