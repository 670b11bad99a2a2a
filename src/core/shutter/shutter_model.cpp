// SPDX-License-Identifier: BSD-3-Clause
#include "core/shutter/shutter_model.h"

#include <algorithm>

namespace mivo {

void ShutterModel::add(const Alignment& alignment) {
  readout_.add(alignment.readout);
  depth_offset_.add(alignment.depth_offset);
}

void ShutterModel::endKeyframe(const ShutterParameters& parameters, double period) {
  readout_.endKeyframe();
  if (!parameters.depth_time_offset_estimation) return;
  if (parameters.depth_time_offset != given_depth_offset_) {
    // What was found beside another one no longer holds.
    depth_offset_ = DepthOffsetEstimator();
    given_depth_offset_ = parameters.depth_time_offset;
  }
  if (period > 0.0) depth_offset_.endKeyframe();
}

ShutterTimes ShutterModel::times(const ShutterParameters& parameters, double period) const {
  ShutterTimes times;
  if (parameters.rolling_shutter_readout == 0.0) {
    times.readout = parameters.rolling_shutter_estimation ? readout_.readout() : 0.0;
  } else if (period > 0.0) {
    times.readout = std::min(1.0, parameters.rolling_shutter_readout / period);
  }
  if (period > 0.0) times.depth_offset = parameters.depth_time_offset / period;
  if (parameters.depth_time_offset_estimation) times.depth_offset += depth_offset_.offset();
  return times;
}

}  // namespace mivo
