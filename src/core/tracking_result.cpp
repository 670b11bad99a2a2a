// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/tracking_result.h"

namespace mivo {

const char* toString(TrackingState state) {
  switch (state) {
    case TrackingState::kInitialising:
      return "initialising";
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
      return "frame does not fit the camera or is not newer";
    case TrackingReason::kTooFewPoints:
      return "too few points with depth and texture";
    case TrackingReason::kNoOverlap:
      return "too little of the keyframe in view";
    case TrackingReason::kNoInformation:
      return "image has nothing in common with the keyframe";
    case TrackingReason::kSingular:
      return "image does not fix all directions";
    case TrackingReason::kImplausibleMotion:
      return "motion faster than the limits";
    case TrackingReason::kNotFinite:
      return "alignment diverged";
  }
  return "unknown";
}

}  // namespace mivo
