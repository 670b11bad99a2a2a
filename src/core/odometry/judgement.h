// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/alignment/align.h"
#include "mivo/core/parameters.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// Why an alignment cannot be believed, by what it measured itself: not finite, nothing in common
/// (depth alone counts only in the dark: an image that shows something else is of another place,
/// however well some of its planes fit), too little overlap, too few points. kNone: it can.
TrackingReason judge(const Alignment& alignment, const LossParameters& parameters);

/// kImplausibleMotion if a camera that moved like this within so many seconds was faster than the
/// limits; kNone if not. @param motion translation m, rotation vector rad
TrackingReason judgeMotion(const Vector6& motion, double seconds, const LossParameters& parameters);

/// Whether an alignment is good enough to be believed without its history.
bool isConvincing(const Alignment& alignment, const LossParameters& parameters);

/// How good a believed alignment is: tracking, or degraded and why.
struct Quality {
  TrackingState state = TrackingState::kTracking;
  TrackingReason reason = TrackingReason::kNone;
};
/// @param is_ambiguous another pose explains the frame as well
Quality qualityOf(const Alignment& alignment, bool is_ambiguous);

}  // namespace mivo
