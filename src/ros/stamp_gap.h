// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <algorithm>
#include <deque>

namespace mivo {

/// Smallest time between two stamps of a topic, of the last second or so.
class StampGap {
 public:
  void add(const ros::Time& stamp) {
    if (!last_.isZero() && stamp > last_) {
      gaps_.push_back(stamp - last_);
      if (gaps_.size() > kGaps) gaps_.pop_front();
    }
    last_ = stamp;
  }

  /// Zero until some stamps have been seen.
  ros::Duration smallest() const {
    return gaps_.size() < kEnough ? ros::Duration() : *std::min_element(gaps_.begin(), gaps_.end());
  }

 private:
  static constexpr std::size_t kGaps = 30;
  static constexpr std::size_t kEnough = 10;

  ros::Time last_;
  std::deque<ros::Duration> gaps_;
};

}  // namespace mivo
