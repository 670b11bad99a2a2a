// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>

namespace mivo {

/// Rate and losses of one stream, from device stamps and frame numbers.
class RateMonitor {
 public:
  /// @param stamp device time, microseconds  @param index the driver's frame number
  void add(std::uint64_t stamp, int index);

  /// Forgets the rate and starts the numbering anew; counts stay.
  void restart();

  /// Hz over the last three seconds of device time; 0 until they are full.
  double rate() const;

  std::int64_t frames() const { return frames_; }
  std::int64_t dropped() const { return dropped_; }  ///< gaps in the frame numbers

 private:
  std::deque<std::uint64_t> stamps_;
  int last_index_ = 0;
  bool has_last_ = false;
  bool full_ = false;
  std::int64_t frames_ = 0;
  std::int64_t dropped_ = 0;
};

}  // namespace mivo
