// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/row_motion.h"
#include "core/terms/cost_term.h"

namespace mivo {

/// Measurement of the time from color to depth by one frame, in frame periods: correction and
/// inverse variance.
struct DepthOffsetMeasurement {
  double correction = 0.0;
  double information = 0.0;
};

/// A term at a pose: its cost around there, and the covariance of the gradient of that.
struct TermModel {
  QuadraticModel model;
  Matrix6 gradient_covariance = Matrix6::Zero();
};

/// Derivative of the geometric term's cost, nats per frame period, with respect to the offset at a
/// fixed pose.
double depthOffsetGradient(const QuadraticModel& depth, const RowVelocities& velocities);

/// Measures the difference between the poses preferred by depth and by the image along the motion
/// of depth per frame period: the offset is a seventh unknown; the pose is eliminated. Not
/// observable while the camera moves as it did at the keyframe.
/// @param image, @param depth the two terms at one pose. @param median_depth of the points, m.
DepthOffsetMeasurement measureDepthOffset(const TermModel& image, const TermModel& depth,
                                          const RowVelocities& velocities, double median_depth);

/// Estimates the correction of the given offset while tracking. It stays zero until several
/// keyframes agree on more than a tenth of a frame period, and then follows their mean.
class DepthOffsetEstimator {
 public:
  /// Adds the measurement of a frame tracked against a keyframe of known velocity.
  void add(const DepthOffsetMeasurement& measurement);

  /// Ends the interval of a keyframe: the only time at which the estimate changes.
  void endKeyframe();

  /// Frame periods, -1..1, beyond what was given.
  double offset() const { return offset_; }

 private:
  void decide();

  double weighted_sum_ = 0.0;  // of this keyframe
  double information_ = 0.0;
  // Over keyframes, former ones fade: of weights, their squares, and weighted offsets.
  double weights_ = 0.0;
  double squared_weights_ = 0.0;
  double offsets_ = 0.0;
  double squared_offsets_ = 0.0;
  bool is_on_ = false;
  double offset_ = 0.0;
};

}  // namespace mivo
