// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/velocity_filter.h"

#include "core/alignment/pose_covariance.h"
#include "core/symmetric.h"

namespace mivo {
namespace {

Matrix6 unknownVelocity(const MotionParameters& parameters) {
  return diagonalCovariance(parameters.expected_speed, parameters.expected_turn_rate);
}

/// By how much the velocity may change in so many seconds: no more than if it was unknown.
Matrix6 changeWithin(double seconds, const MotionParameters& parameters) {
  return diagonalCovariance(parameters.expected_acceleration * seconds,
                            parameters.expected_turn_acceleration * seconds)
      .cwiseMin(unknownVelocity(parameters));
}

}  // namespace

void VelocityFilter::reset(const MotionParameters& parameters) {
  twist_per_period_.setZero();
  covariance_ = unknownVelocity(parameters);
  is_known_ = false;
}

void VelocityFilter::add(const MeasuredMotion& motion, const MotionParameters& parameters) {
  const Matrix6 change = changeWithin(motion.seconds, parameters);
  const Matrix6 before =
      is_known_ ? Matrix6(covariance_now_ + change) : unknownVelocity(parameters);
  const Matrix6 measured = motion.covariance / (motion.seconds * motion.seconds);
  const Vector6 of_motion = motion.twist / motion.periods;
  Matrix6 after = measured;
  if (parameters.motion_model == MotionModelKind::kFilteredVelocity) {
    const Matrix6 gain = symmetricSolve(before + measured, before).transpose();
    twist_per_period_ += gain * (of_motion - twist_per_period_);
    after = before - gain * before;
  } else {
    twist_per_period_ = of_motion;
  }
  if (motion.has_open_directions) return;
  covariance_now_ = 0.5 * (after + after.transpose());
  covariance_ = covariance_now_ + change;
  is_known_ = true;
}

}  // namespace mivo
