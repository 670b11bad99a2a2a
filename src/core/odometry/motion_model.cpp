// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/motion_model.h"

#include <algorithm>
#include <cmath>

#include "core/alignment/pose_covariance.h"

namespace mivo {
namespace {

/// Diagonal of the squares of a speed (m/s) and a turn rate (rad/s).
Matrix6 squares(double speed, double turn_rate) {
  return diagonalCovariance(speed, turn_rate);
}

/// Integral over time of the deviation of the unknown part of the velocity, sqrt(1 - exp(-2 u)), in
/// units of kMotionHorizon.
double integralOfGrowth(double u) {
  constexpr double kLong = 20.0;  // exp(-2 u) is nothing any more
  if (u > kLong) return u + std::log(2.0) - 1.0;
  return u > 0.0 ? std::acosh(std::exp(u)) - std::sqrt(1.0 - std::exp(-2.0 * u)) : 0.0;
}

}  // namespace

void MotionModel::add(const MeasuredPose& pose, const FrameClock& clock,
                      const MotionParameters& parameters) {
  has_velocity_ = has_pose_;
  if (has_velocity_) {
    motion_ = logSe3(last_.T_odom_camera.inverse() * pose.T_odom_camera);
    previous_stamp_ = last_.stamp;
  }
  const Matrix6 covariance_before = last_.alignment_covariance;
  last_ = pose;
  const bool is_first = !has_pose_;
  has_pose_ = true;
  const double num_periods = periods(clock, parameters);
  const double period = clock.period(parameters);
  const double seconds = num_periods * period;
  const bool is_measured = has_velocity_ && seconds > 0.0;
  if (is_measured) {
    filter_.add({motion_, covariance_before + pose.alignment_covariance, num_periods, seconds,
                 pose.has_open_directions},
                parameters);
  }
  if (pose.has_open_directions && !is_first) return;
  seen_ = pose;
  if (!is_measured) filter_.reset(parameters);
  const Vector6& twist = filter_.twistPerPeriod();
  seen_speed_ = is_measured ? twist.head<3>().norm() / period : 0.0;
  seen_turn_rate_ = is_measured ? twist.tail<3>().norm() / period : 0.0;
}

void MotionModel::stop() {
  has_pose_ = false;
  has_velocity_ = false;
  motion_.setZero();
}

void MotionModel::transform(const Eigen::Isometry3d& T_new_old) {
  for (MeasuredPose* pose : {&last_, &seen_}) {
    pose->T_odom_camera = orthonormalized(T_new_old * pose->T_odom_camera);
  }
}

/// Frame periods between the last two poses.
double MotionModel::periods(const FrameClock& clock, const MotionParameters& parameters) const {
  return has_velocity_ ? clock.periodsBetween(previous_stamp_, last_.stamp, parameters) : 1.0;
}

/// Time since the open directions of the last pose were observed.
double MotionModel::secondsUnseen(double stamp) const {
  return std::max(0.0, stamp - seen_.stamp);
}

Vector6 MotionModel::motionUntil(double stamp, const FrameClock& clock,
                                 const MotionParameters& parameters) const {
  const double period = clock.period(parameters);
  const double wanted = clock.periodsBetween(last_.stamp, stamp, parameters);
  const auto within = [&](double seconds) {
    return period > 0.0 ? std::min(wanted, std::max(0.0, seconds) / period) : wanted;
  };
  const double of_seen = within(std::max(kMotionHorizon, period));
  const Vector6& twist = filter_.twistPerPeriod();
  if (!last_.has_open_directions) return of_seen * twist;
  const double of_open = within(kMotionHorizon - secondsUnseen(last_.stamp));
  return of_seen * twist + (of_open - of_seen) * (last_.open_projector * twist);
}

Eigen::Isometry3d MotionModel::predict(double stamp, const Eigen::Isometry3d& last,
                                       const FrameClock& clock,
                                       const MotionParameters& parameters) const {
  if (parameters.motion_model == MotionModelKind::kConstantPose || !has_velocity_) return last;
  return orthonormalized(last_.T_odom_camera * expSe3(motionUntil(stamp, clock, parameters)));
}

/// Covariance of the drift during so many seconds without observation: the velocity remains known
/// for about half a second and is arbitrary after that.
Matrix6 MotionModel::driftWithin(double seconds, const MotionParameters& parameters) const {
  const double u = seconds / kMotionHorizon;
  const double of_known = kMotionHorizon * (1.0 - std::exp(-u));
  const double of_unknown = kMotionHorizon * integralOfGrowth(u);
  return of_known * of_known * filter_.covariance() +
         of_unknown * of_unknown *
             squares(std::max(seen_speed_, parameters.expected_speed),
                     std::max(seen_turn_rate_, parameters.expected_turn_rate));
}

double MotionModel::secondsSinceLast(double stamp, const FrameClock& clock,
                                     const MotionParameters& parameters) const {
  const double period = clock.period(parameters);
  return clock.periodsBetween(last_.stamp, stamp, parameters) *
         (period > 0.0 ? period : std::max(0.0, stamp - last_.stamp));
}

Matrix6 MotionModel::drift(double stamp, const FrameClock& clock,
                           const MotionParameters& parameters) const {
  return driftWithin(secondsSinceLast(stamp, clock, parameters), parameters) + floorCovariance();
}

Matrix6 MotionModel::covariance(double stamp, const FrameClock& clock,
                                const MotionParameters& parameters) const {
  const double since_last = secondsSinceLast(stamp, clock, parameters);
  const Matrix6 of_seen = last_.covariance + driftWithin(since_last, parameters);
  if (!last_.has_open_directions) return of_seen;
  const Matrix6 to_last = adjoint(last_.T_odom_camera.inverse() * seen_.T_odom_camera);
  const Matrix6 of_open = to_last * seen_.covariance * to_last.transpose() +
                          driftWithin(secondsUnseen(last_.stamp) + since_last, parameters);
  const Matrix6& open = last_.open_projector;
  const Matrix6 seen = Matrix6::Identity() - open;
  return seen * of_seen * seen.transpose() + open * of_open * open.transpose() + floorCovariance();
}

Vector6 MotionModel::velocity(const FrameClock& clock, const MotionParameters& parameters) const {
  const double period = clock.period(parameters);
  if (!has_velocity_ || !(period > 0.0)) return Vector6::Zero();
  return motion_ / (periods(clock, parameters) * period);
}

double MotionModel::periodsSince(double stamp, const FrameClock& clock,
                                 const MotionParameters& parameters) const {
  return has_pose_ ? clock.periodsBetween(last_.stamp, stamp, parameters) : 1.0;
}

}  // namespace mivo
