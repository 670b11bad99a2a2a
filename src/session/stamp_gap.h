// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>

namespace mivo {

/// Smallest interval between stamps of a stream, over about the last second.
class StampGap {
 public:
  void add(double stamp) {
    if (last_ && stamp > *last_) {
      gaps_.push_back(stamp - *last_);
      if (gaps_.size() > kGaps) gaps_.pop_front();
    }
    last_ = stamp;
  }

  /// s; zero until enough stamps were added.
  double smallest() const {
    return gaps_.size() < kEnough ? 0.0 : *std::min_element(gaps_.begin(), gaps_.end());
  }

 private:
  static constexpr std::size_t kGaps = 30;
  static constexpr std::size_t kEnough = 10;

  std::optional<double> last_;
  std::deque<double> gaps_;
};

}  // namespace mivo
