// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/rate_monitor.h"

namespace mivo {
namespace {
constexpr std::uint64_t kWindow = 3000000;  // microseconds
constexpr double kMicrosecondsPerSecond = 1e6;
}  // namespace

void RateMonitor::add(std::uint64_t stamp, int index) {
  ++frames_;
  if (has_last_ && index > last_index_ + 1) {
    dropped_ += index - last_index_ - 1;
  }
  last_index_ = index;
  has_last_ = true;

  if (!stamps_.empty() && stamp < stamps_.back()) {
    stamps_.clear();
    full_ = false;
  }
  stamps_.push_back(stamp);
  while (stamps_.back() - stamps_.front() > kWindow) {
    stamps_.pop_front();
    full_ = true;
  }
}

void RateMonitor::restart() {
  stamps_.clear();
  has_last_ = false;
  full_ = false;
}

double RateMonitor::rate() const {
  if (!full_ || stamps_.size() < 2) {
    return 0.0;
  }
  return static_cast<double>(stamps_.size() - 1) * kMicrosecondsPerSecond /
         static_cast<double>(stamps_.back() - stamps_.front());
}

}  // namespace mivo
