// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/alignment/align.h"
#include "core/geometry/row_motion.h"
#include "core/shutter/depth_offset_estimator.h"
#include "core/shutter/readout_estimator.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Read-out times of the camera: given by parameters or estimated. Estimates change only when a
/// keyframe is created, because its points are corrected with them.
class ShutterModel {
 public:
  /// Adds the measurements of a frame tracked against a keyframe of known velocity.
  void add(const Alignment& alignment);

  /// When a keyframe is made. @param period s between two frames; 0: not known yet.
  void endKeyframe(const ShutterParameters& parameters, double period);

  /// In frame periods. @param period see endKeyframe().
  ShutterTimes times(const ShutterParameters& parameters, double period) const;

 private:
  ReadoutEstimator readout_;
  DepthOffsetEstimator depth_offset_;
  double given_depth_offset_ = 0.0;  // s, what depth_offset_ is beside
};

}  // namespace mivo
