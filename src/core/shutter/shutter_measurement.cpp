// SPDX-License-Identifier: BSD-3-Clause
#include "core/shutter/shutter_measurement.h"

namespace mivo {
namespace {

TermModel modelOf(CostTerm& term) {
  TermModel result;
  result.model = term.linearize(kScaleIsKept);
  if (term.gradientCovariance(result.gradient_covariance) < kFewestBlocks) {
    result.gradient_covariance = result.model.hessian;
  }
  return result;
}

}  // namespace

ShutterMeasurement measureShutter(const ReferencePoints& points, SsdTerm& image,
                                  GeometricTerm* geometry, double height,
                                  const RowVelocities& velocities, const Parameters& parameters) {
  ShutterMeasurement measurement;
  const ShutterParameters& shutter = parameters.shutter;
  if (shutter.rolling_shutter_estimation && shutter.rolling_shutter_readout == 0.0) {
    measurement.readout = measureReadout(points, image.residuals(), image.samples().v, height,
                                         image.scale(), velocities);
  }
  if (shutter.depth_time_offset_estimation && geometry != nullptr) {
    // Both terms are evaluated at the same pose, possibly one step before the last; the measurement
    // accounts for it.
    measurement.depth_offset = measureDepthOffset(modelOf(image), modelOf(*geometry), velocities,
                                                  static_cast<double>(points.median_depth));
  }
  return measurement;
}

}  // namespace mivo
