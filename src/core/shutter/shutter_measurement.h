// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/keyframe/reference_points.h"
#include "core/shutter/depth_offset_estimator.h"
#include "core/shutter/readout_estimator.h"
#include "core/terms/geometric_term.h"
#include "core/terms/ssd_term.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Measurement of the shutter by one frame.
struct ShutterMeasurement {
  ReadoutMeasurement readout;
  DepthOffsetMeasurement depth_offset;
};

/// Measures the quantities to be estimated, from the terms at the end of a level.
/// @param geometry none where depth took no part
ShutterMeasurement measureShutter(const ReferencePoints& points, SsdTerm& image,
                                  GeometricTerm* geometry, double height,
                                  const RowVelocities& velocities, const Parameters& parameters);

}  // namespace mivo
