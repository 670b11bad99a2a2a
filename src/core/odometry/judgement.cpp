// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/judgement.h"

namespace mivo {

TrackingReason judge(const Alignment& alignment, const Parameters& parameters) {
  if (!alignment.T_live_ref.matrix().allFinite() || !alignment.hessian.allFinite()) {
    return TrackingReason::kNotFinite;
  }
  if (!alignment.sees_image && !(alignment.sees_depth && alignment.isDepthOnly())) {
    return TrackingReason::kNothingInCommon;
  }
  if (alignment.overlap < parameters.loss.lost_overlap) return TrackingReason::kNoOverlap;
  if (alignment.points < parameters.loss.lost_points) return TrackingReason::kTooFewPoints;
  if (!alignment.covariance.allFinite()) return TrackingReason::kOpenDirections;
  return TrackingReason::kNone;
}

TrackingReason judgeMotion(const Vector6& motion, double seconds, const Parameters& parameters) {
  const bool is_plausible = motion.head<3>().norm() <= parameters.loss.lost_speed * seconds &&
                            motion.tail<3>().norm() <= parameters.loss.lost_turn_rate * seconds;
  return is_plausible ? TrackingReason::kNone : TrackingReason::kImplausibleMotion;
}

bool isConvincing(const Alignment& alignment, const Parameters& parameters) {
  return parameters.alignment.method == Method::kMi ||
         (alignment.sees_image && alignment.correlation >= parameters.loss.retry_correlation);
}

Quality qualityOf(const Alignment& alignment, const Parameters& parameters) {
  if (!alignment.sees_image) return {TrackingState::kDegraded, TrackingReason::kNothingInCommon};
  if (alignment.condition < parameters.loss.degraded_curvature) {
    return {TrackingState::kDegraded, TrackingReason::kOpenDirections};
  }
  return {};
}

}  // namespace mivo
