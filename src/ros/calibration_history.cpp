// SPDX-License-Identifier: BSD-3-Clause
#include "ros/calibration_history.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace mivo {
namespace {

// Live, the camera may run for years; what is this far back is asked for no more.
constexpr std::size_t kMaxChanges = 10000;
// Of a value, or of 1 where that is more: what is written as text and read again, or computed in
// floats, differs by less, and a pixel's place by a thousandth.
constexpr double kRounding = 1e-6;

bool isUncalibrated(const sensor_msgs::CameraInfo& info) {
  const auto is_zero = [](double value) { return value == 0.0; };
  return std::all_of(info.K.begin(), info.K.end(), is_zero) &&
         std::all_of(info.P.begin(), info.P.end(), is_zero);
}

/// But for rounding.
template <typename List>
bool isSame(const List& a, const List& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return std::abs(x - y) <= kRounding * std::max(1.0, std::abs(x));
         });
}

bool isSame(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  return a.width == b.width && a.height == b.height && a.distortion_model == b.distortion_model &&
         isSame(a.D, b.D) && isSame(a.K, b.K) && isSame(a.P, b.P) && a.binning_x == b.binning_x &&
         a.binning_y == b.binning_y && a.roi == b.roi;
}

}  // namespace

void CalibrationHistory::add(double stamp, const sensor_msgs::CameraInfoConstPtr& message) {
  if (changes_.empty() && isUncalibrated(*message)) {
    saw_uncalibrated_ = true;
    return;
  }
  if (latest_ && isSame(*latest_, *message)) return;
  latest_ = message;
  changes_[stamp] = message;
  if (changes_.size() > kMaxChanges) changes_.erase(changes_.begin());
}

sensor_msgs::CameraInfoConstPtr CalibrationHistory::at(double stamp) const {
  if (changes_.empty()) return nullptr;
  const auto later = changes_.upper_bound(stamp);
  return later == changes_.begin() ? later->second : std::prev(later)->second;
}

}  // namespace mivo
