// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/geometry/row_motion.h"
#include "core/keyframe/reference_points.h"
#include "core/terms/robust_sum.h"

namespace mivo {

/// Measurement of the read-out time by one frame, as a fraction of the frame period: correction and
/// inverse variance (as far as the residuals show).
struct ReadoutMeasurement {
  double correction = 0.0;
  double information = 0.0;
};

/// Measures from the residuals at the end of a level: the read-out time is a seventh unknown; the
/// pose is eliminated. @param live_rows row of each point in the live image, pixels;
/// @param height of the level, @param scale of the residuals.
ReadoutMeasurement measureReadout(const ReferencePoints& points, const Residuals& residuals,
                                  const std::vector<float>& live_rows, double height, double scale,
                                  const RowVelocities& velocities);

/// Estimates the read-out time while tracking. It stays zero until two successive keyframes
/// indicate a rolling shutter significantly, and then follows their measurements.
class ReadoutEstimator {
 public:
  /// Adds the measurement of a frame tracked against a keyframe of known velocity.
  void add(const ReadoutMeasurement& measurement);

  /// Ends the interval of a keyframe: the only time at which the estimate changes, for the points
  /// of a keyframe are corrected for it when it is made.
  void endKeyframe();

  /// Read-out time as a share of the frame period, 0..1; 0: a global shutter.
  double readout() const { return readout_; }

 private:
  void decide(double correction);

  double weighted_sum_ = 0.0;
  double information_ = 0.0;
  double last_correction_ = 0.0;
  double sum_while_off_ = 0.0;  // as above, over the keyframes for which the shutter was global
  double information_while_off_ = 0.0;
  bool is_on_ = false;
  int updates_ = 0;
  int keyframes_on_ = 0;
  double caution_ = 1.0;  // factor on what it takes to switch on
  double estimate_ = 0.0;
  double readout_ = 0.0;
};

}  // namespace mivo
