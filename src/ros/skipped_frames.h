// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace mivo {

/// How many frames were skipped, and why.
struct SkipCounts {
  std::uint64_t total = 0;
  std::string last_reason;
  std::map<std::string, std::uint64_t> by_reason;
};

/// Frames that have no pose because they could not be used or were refused. May be called from any
/// thread.
class SkippedFrames {
 public:
  /// Counts a frame, and tells a new reason at once, one that lasts every minute. Returns whether
  /// it was told.
  bool add(const std::string& reason, const ros::WallTime& now);

  SkipCounts counts() const;

 private:
  mutable std::mutex mutex_;
  SkipCounts counts_;
  std::map<std::string, ros::WallTime> told_;
};

}  // namespace mivo
