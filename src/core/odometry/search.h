// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "core/alignment/align.h"
#include "core/images/frame_pyramid.h"
#include "core/keyframe/keyframe_store.h"
#include "core/odometry/odometry_state.h"
#include "core/odometry/prediction.h"
#include "mivo/core/camera.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// A frame and the data to align it with.
struct SearchInput {
  const OdometryState& state;
  const KeyframeStore& keyframes;
  const FramePyramid& live;
  const Camera& camera;
  const Parameters& parameters;
};

/// Alignment of a frame with a keyframe, and the reason to reject it; kNone: accepted.
struct Sight {
  Alignment alignment;
  std::size_t keyframe = 0;  ///< index in the store
  TrackingReason reason = TrackingReason::kNone;
  bool is_ambiguous = false;  ///< another pose explains the frame as well: it is in the covariance
};

/// Aligns the frame with the current keyframe from the prediction, and judges the result. When
/// its image hardly agrees, or the motion surprises, other starts compete with it; when it cannot
/// be believed other keyframes are tried, too.
Sight findCamera(const SearchInput& input, const Prediction& prediction);

}  // namespace mivo
