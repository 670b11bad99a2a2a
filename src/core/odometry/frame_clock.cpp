// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/frame_clock.h"

#include <algorithm>
#include <cmath>

namespace mivo {

void FrameClock::add(double stamp) {
  if (has_stamp_ && stamp > last_stamp_) {
    intervals_[next_interval_] = stamp - last_stamp_;
    next_interval_ = (next_interval_ + 1) % kIntervals;
    num_intervals_ = std::min(num_intervals_ + 1, kIntervals);
  }
  last_stamp_ = stamp;
  has_stamp_ = true;
}

double FrameClock::period(const MotionParameters& parameters) const {
  if (parameters.frame_period > 0.0) return parameters.frame_period;
  if (num_intervals_ == 0) return 0.0;
  std::array<double, kIntervals> sorted = intervals_;
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(num_intervals_);
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(num_intervals_ / 2);
  std::nth_element(sorted.begin(), middle, end);
  return *middle;
}

double FrameClock::periodsBetween(double from, double to,
                                  const MotionParameters& parameters) const {
  const double period_s = period(parameters);
  return period_s > 0.0 ? std::max(1.0, std::round((to - from) / period_s)) : 1.0;
}

}  // namespace mivo
