// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/alignment/align.h"
#include "mivo/core/parameters.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// Reason to reject an alignment by its own measurements: not finite, image unrelated to the
/// keyframe, too little overlap, too few points. kNone: accepted. Depth alone is accepted only in
/// the dark: some planes of an unrelated place may fit as well.
TrackingReason judge(const Alignment& alignment, const LossParameters& parameters);

/// kImplausibleMotion if the motion within `seconds` exceeds the limits, otherwise kNone. @param
/// motion translation m, rotation vector rad
TrackingReason judgeMotion(const Vector6& motion, double seconds, const LossParameters& parameters);

/// Whether an alignment is acceptable without a predicted pose.
bool isConvincing(const Alignment& alignment, const LossParameters& parameters);

/// State of an accepted alignment: tracking, or degraded with the reason.
struct Quality {
  TrackingState state = TrackingState::kTracking;
  TrackingReason reason = TrackingReason::kNone;
};
/// @param is_ambiguous another pose explains the frame as well
Quality qualityOf(const Alignment& alignment, bool is_ambiguous);

}  // namespace mivo
