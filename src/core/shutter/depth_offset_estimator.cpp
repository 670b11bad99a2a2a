// SPDX-License-Identifier: BSD-3-Clause
#include "core/shutter/depth_offset_estimator.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/alignment/pose_covariance.h"

namespace mivo {
namespace {

// Poses by depth and by image differ by this for other reasons, and so do velocities, rad. It keeps
// a camera that hardly moves from having its say.
constexpr double kModelErrorAngle = 4e-4;
// One frame counts at most this much: the errors of a keyframe's frames are not independent.
constexpr double kMaxInformation = 100.0;
// |correction|, |offset| <= this, frame periods: more is another frame's depth, which pairing, not
// this, has to find. A frame far off is clipped, so that none turns the mean alone.
constexpr double kMaxCorrection = 1.0;
constexpr double kMaxOffset = 1.0;
// information >= the first, or a keyframe says nothing: its deviation would be 0.18 periods and
// more. It counts at most the other, so that one long keyframe does not outvote all.
constexpr double kMinKeyframe = 30.0;
constexpr double kMaxKeyframe = 300.0;
// What former keyframes keep of their weight with each new one: about the last ten count.
constexpr double kMemory = 0.9;
// It is believed when so many keyframes differ from none by so many deviations of their mean,
constexpr double kKeyframes = 3.0;
constexpr double kDeviations = 4.0;
// and is at least this, frame periods. Less is not told from registration and model errors.
constexpr double kNoneBelow = 0.1;
// Once believed it is held until it is less than half of that: no switching to and fro.
constexpr double kForgottenBelow = 0.05;
// From keyframe to keyframe it changes by no more: first keyframes may exaggerate, and the read-out
// is being estimated from the same motion.
constexpr double kStepLimit = 0.1;
// What each keyframe may be wrong by however well a few agree, frame periods: three tell 0.25,
// seven 0.15.
constexpr double kDeviation = 0.1;

/// A later depth image lets a point of the keyframe be where it was earlier, and what is seen of
/// it, too: the plane and the reading move against each other by this, in the axes of the keyframe.
/// They move as one rigid body, so that it is an increment of the pose, of the depth alone.
Vector6 slip(const RowVelocities& velocities) {
  return velocities.liveInKeyframe() - velocities.keyframe;
}

}  // namespace

double depthOffsetGradient(const QuadraticModel& depth, const RowVelocities& velocities) {
  return -slip(velocities).dot(depth.gradient);
}

void DepthOffsetEstimator::add(const DepthOffsetMeasurement& measurement) {
  const double information = std::min(measurement.information, kMaxInformation);
  information_ += information;
  weighted_sum_ +=
      information * std::min(std::max(measurement.correction, -kMaxCorrection), kMaxCorrection);
}

void DepthOffsetEstimator::endKeyframe() {
  if (information_ >= kMinKeyframe) decide();
  weighted_sum_ = 0.0;
  information_ = 0.0;
}

void DepthOffsetEstimator::decide() {
  // What the keyframe says is a correction of the offset in use.
  const double said =
      std::min(std::max(offset_ + weighted_sum_ / information_, -kMaxOffset), kMaxOffset);
  const double weight = std::min(information_, kMaxKeyframe);
  weights_ = kMemory * weights_ + weight;
  squared_weights_ = kMemory * kMemory * squared_weights_ + weight * weight;
  offsets_ = kMemory * offsets_ + weight * said;
  squared_offsets_ = kMemory * squared_offsets_ + weight * said * said;
  const double mean = offsets_ / weights_;
  const double keyframes = weights_ * weights_ / squared_weights_;
  const double variance = std::max(0.0, squared_offsets_ / weights_ - mean * mean);
  const double deviation = std::sqrt((variance + kDeviation * kDeviation) / keyframes);
  if (is_on_) {
    is_on_ = std::abs(mean) >= kForgottenBelow;
  } else {
    is_on_ = keyframes >= kKeyframes && std::abs(mean) >= kNoneBelow &&
             std::abs(mean) > kDeviations * deviation;
  }
  const double step = std::min(std::max(mean - offset_, -kStepLimit), kStepLimit);
  offset_ = is_on_ ? offset_ + step : 0.0;
}

DepthOffsetMeasurement measureDepthOffset(const TermModel& image, const TermModel& depth,
                                          const RowVelocities& velocities, double median_depth) {
  // Of cost_image(d) + cost_depth(d - offset u), with d and the offset unknown.
  const Vector6 u = slip(velocities);
  const Eigen::LDLT<Matrix6> pose(image.model.hessian + depth.model.hessian);
  if (pose.info() != Eigen::Success || !pose.isPositive()) return {};
  const Vector6 coupling = depth.model.hessian * u;
  const Vector6 followed = pose.solve(coupling);  // by the pose, of the way that depth goes
  const Vector6 rest = u - followed;
  const double curvature = coupling.dot(rest);
  const double gradient = rest.dot(depth.model.gradient) - followed.dot(image.model.gradient);
  if (!(curvature > 0.0) || !std::isfinite(gradient)) return {};
  const Vector6 by_depth = depth.model.hessian * rest;
  const double variance =
      followed.dot(image.gradient_covariance * followed) +
      rest.dot(depth.gradient_covariance * rest) +
      by_depth.dot(diagonalCovariance(kModelErrorAngle * median_depth, kModelErrorAngle) *
                   by_depth);
  if (!(variance > 0.0)) return {};
  return {gradient / curvature, curvature * curvature / variance};
}

}  // namespace mivo
