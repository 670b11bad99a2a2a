// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/judgment.h"

namespace mivo {

TrackingReason judge(const Alignment& alignment, const LossParameters& parameters) {
  if (!alignment.T_live_ref.matrix().allFinite() || !alignment.hessian.allFinite() ||
      !alignment.covariance.allFinite()) {
    return TrackingReason::kNotFinite;
  }
  if (!alignment.sees_image && !(alignment.sees_depth && alignment.isDepthOnly())) {
    return TrackingReason::kNothingInCommon;
  }
  if (alignment.overlap < parameters.lost_overlap) return TrackingReason::kNoOverlap;
  if (alignment.points < parameters.lost_points) return TrackingReason::kTooFewPoints;
  return TrackingReason::kNone;
}

TrackingReason judgeMotion(const Vector6& motion, double seconds,
                           const LossParameters& parameters) {
  const bool is_plausible = motion.head<3>().norm() <= parameters.lost_speed * seconds &&
                            motion.tail<3>().norm() <= parameters.lost_turn_rate * seconds;
  return is_plausible ? TrackingReason::kNone : TrackingReason::kImplausibleMotion;
}

bool isConvincing(const Alignment& alignment, const LossParameters& parameters) {
  return alignment.sees_image && alignment.correlation >= parameters.retry_correlation;
}

Quality qualityOf(const Alignment& alignment, bool is_ambiguous) {
  if (alignment.has_open_directions) {
    return {TrackingState::kDegraded, TrackingReason::kOpenDirections};
  }
  if (!alignment.sees_image) return {TrackingState::kDegraded, TrackingReason::kNothingInCommon};
  if (is_ambiguous) return {TrackingState::kDegraded, TrackingReason::kAmbiguous};
  return {};
}

}  // namespace mivo
