// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace mivo {

/// Numbers of skipped frames by reason.
struct SkipCounts {
  std::uint64_t total = 0;
  std::string last_reason;
  std::map<std::string, std::uint64_t> by_reason;
};

/// Counts frames that were unusable or refused. Thread-safe.
class SkippedFrames {
 public:
  /// Counts a frame. Logs a new reason at once, a repeated one at most once a minute. Returns
  /// whether it was logged.
  bool add(const std::string& reason, const ros::WallTime& now);

  SkipCounts counts() const;

 private:
  mutable std::mutex mutex_;
  SkipCounts counts_;
  std::map<std::string, ros::WallTime> told_;
};

}  // namespace mivo
