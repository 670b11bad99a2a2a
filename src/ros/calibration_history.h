// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <cstddef>
#include <map>

namespace mivo {

/// The calibrations of a camera over time. Drivers send one with each image, nearly always the
/// same: only changes are kept, and rounding is none.
class CalibrationHistory {
 public:
  /// Messages without any calibration (all zero) that come before the first real one are passed
  /// over: drivers send them until the camera is open.
  void add(double stamp, const sensor_msgs::CameraInfoConstPtr& message);

  /// Whether there is one, and, if not, whether all that came were zero.
  bool empty() const { return changes_.empty(); }
  std::size_t size() const { return changes_.size(); }
  bool sawUncalibrated() const { return saw_uncalibrated_; }

  /// The newest one not later than a stamp (s), otherwise the first; null when there is none.
  sensor_msgs::CameraInfoConstPtr at(double stamp) const;

 private:
  std::map<double, sensor_msgs::CameraInfoConstPtr> changes_;  // by the stamp from which it holds
  sensor_msgs::CameraInfoConstPtr latest_;
  bool saw_uncalibrated_ = false;
};

}  // namespace mivo
