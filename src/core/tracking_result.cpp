// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/tracking_result.h"

namespace mivo {

const char* toString(TrackingState state) {
  switch (state) {
    case TrackingState::kInitializing:
      return "initializing";
    case TrackingState::kTracking:
      return "tracking";
    case TrackingState::kDegraded:
      return "degraded";
    case TrackingState::kLost:
      return "lost";
  }
  return "unknown";
}

const char* toString(TrackingReason reason) {
  switch (reason) {
    case TrackingReason::kNone:
      return "none";
    case TrackingReason::kInvalidFrame:
      return "frame does not match the camera";
    case TrackingReason::kStaleStamp:
      return "stamp is not newer than that of the frame before";
    case TrackingReason::kTooFewPoints:
      return "too few points with depth and texture";
    case TrackingReason::kNoOverlap:
      return "too little of the keyframe in view";
    case TrackingReason::kNothingInCommon:
      return "image has nothing in common with the keyframe";
    case TrackingReason::kOpenDirections:
      return "motion is not observable in some directions";
    case TrackingReason::kAmbiguous:
      return "two poses match the image equally well";
    case TrackingReason::kImplausibleMotion:
      return "motion exceeds lost_speed or lost_turn_rate";
    case TrackingReason::kNotFinite:
      return "alignment diverged";
  }
  return "unknown";
}

std::string describeReason(const TrackingResult& result) {
  static constexpr const char* kNames[] = {"sideways",
                                           "up and down",
                                           "forward",
                                           "turning about the sideways axis",
                                           "turning about the vertical axis",
                                           "turning about the viewing axis"};
  std::string names;
  for (std::size_t i = 0; i < result.open_directions.size(); ++i) {
    if (!result.open_directions[i]) continue;
    names += (names.empty() ? " " : ", ") + std::string(kNames[i]);
  }
  if (result.reason != TrackingReason::kOpenDirections || names.empty()) {
    return toString(result.reason);
  }
  return "motion is not observable:" + names;
}

}  // namespace mivo
