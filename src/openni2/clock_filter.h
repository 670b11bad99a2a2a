// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "openni2/camera_device.h"

namespace mivo {

/// Host time of device stamps. An image arrives some time after it was taken, never before: arrival
/// minus device stamp is the clocks' difference plus a delay that is sometimes small. The
/// difference is therefore the lower envelope of what was observed: a line under all points of the
/// last half minute, so that a clock of another rate causes no drift and a late arrival no error.
/// The minimum delay is not observable and remains in the result as a constant.
///
/// For growing device stamps of a stream the result grows. A jump of either clock starts anew.
class ClockFilter {
 public:
  /// Both streams of a device have one clock: feed all their images.
  /// @param device_stamp microseconds  @param arrival host time, ns
  void observe(std::uint64_t device_stamp, std::int64_t arrival);

  /// Host time in ns of a stamp close to the last observed ones; for each stream later than before.
  std::int64_t hostTime(StreamKind kind, std::uint64_t device_stamp);

  /// Forgets the clocks' difference, for another device. Results still grow.
  void reset() { started_ = false; }

  /// Whether the estimate of the clock offset has converged.
  bool isSettled() const;

  /// Rate of the device's clock relative to the host's, minus 1; 0 until it is known.
  double skew() const { return -slope_; }

 private:
  struct Point {
    double device;      ///< s since the first stamp
    double difference;  ///< host - device, s since the first
  };
  struct Bucket {
    std::int64_t number;  ///< of the interval of device time
    Point lowest;
  };

  void restart(std::uint64_t device_stamp, std::int64_t arrival);
  bool isJump(const Point& point);
  void add(const Point& point);
  std::vector<Point> lowerHull() const;
  double offsetBelowAll(double slope) const;
  void fitLine();
  void follow(double device);

  bool started_ = false;
  std::uint64_t first_device_ = 0;
  std::int64_t first_arrival_ = 0;
  std::deque<Bucket> buckets_;
  double last_device_ = 0.0;
  double floor_ = 0.0;       ///< smallest difference so far, but for the last few tenths of a ms
  int quiet_ = 0;            ///< observations since it fell
  int near_ = 0;             ///< moments observed close to it
  double last_near_ = 0.0;   ///< device time of the last of them, s
  int jumped_ = 0;           ///< observations in a row that do not fit
  double slope_ = 0.0;       ///< of the line
  double offset_ = 0.0;      ///< of the line at device time 0
  double applied_ = 0.0;     ///< difference in use: follows the line slowly
  double applied_at_ = 0.0;  ///< device time of it
  std::array<std::int64_t, kStreamKinds> last_{};
};

}  // namespace mivo
