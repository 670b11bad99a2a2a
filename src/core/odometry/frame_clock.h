// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "mivo/core/parameters.h"

namespace mivo {

/// The camera's own time. Stamps jitter by a third of a period while the camera is regular, so the
/// number of periods between two frames is what counts, not their stamps.
class FrameClock {
 public:
  /// Notes the stamp of a frame, with a pose or without; stamps grow.
  void add(double stamp);

  /// Frame period: the parameter, or the median of the last stamps' differences, s; 0: unknown.
  double period(const MotionParameters& parameters) const;

  /// Whole frame periods from one stamp to a later one, at least one.
  double periodsBetween(double from, double to, const MotionParameters& parameters) const;

 private:
  static constexpr std::size_t kIntervals = 31;  // one second of a usual camera

  std::array<double, kIntervals> intervals_{};  // the last ones, as a ring
  std::size_t num_intervals_ = 0;
  std::size_t next_interval_ = 0;
  double last_stamp_ = 0.0;
  bool has_stamp_ = false;
};

}  // namespace mivo
