// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/judgement.h"

namespace mivo {

TrackingReason judge(const Alignment& alignment, const Parameters& parameters) {
  if (!alignment.T_live_ref.matrix().allFinite() || !alignment.information.allFinite()) {
    return TrackingReason::kNotFinite;
  }
  if (!alignment.sees_image && !(alignment.sees_depth && alignment.isBlind())) {
    return TrackingReason::kNoInformation;
  }
  if (alignment.overlap < parameters.lost_overlap) return TrackingReason::kNoOverlap;
  if (alignment.points < parameters.lost_points) return TrackingReason::kTooFewPoints;
  if (!alignment.covariance.allFinite()) return TrackingReason::kSingular;
  return TrackingReason::kNone;
}

TrackingReason judgeMotion(const Vector6& motion, double seconds, const Parameters& parameters) {
  const bool is_plausible = motion.head<3>().norm() <= parameters.lost_speed * seconds &&
                            motion.tail<3>().norm() <= parameters.lost_turn_rate * seconds;
  return is_plausible ? TrackingReason::kNone : TrackingReason::kImplausibleMotion;
}

bool isConvincing(const Alignment& alignment, const Parameters& parameters) {
  return parameters.method == Method::kMi ||
         (alignment.sees_image && alignment.correlation >= parameters.retry_correlation);
}

Quality qualityOf(const Alignment& alignment, const Parameters& parameters) {
  if (!alignment.sees_image) return {TrackingState::kDegraded, TrackingReason::kNoInformation};
  if (alignment.condition < parameters.degraded_curvature) {
    return {TrackingState::kDegraded, TrackingReason::kSingular};
  }
  return {};
}

}  // namespace mivo
