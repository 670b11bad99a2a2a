// SPDX-License-Identifier: BSD-3-Clause
#include "core/shutter/readout_estimator.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/execution/recycled.h"
#include "core/kernels/kernels.h"

namespace mivo {
namespace {

// One frame counts at most this much, or a few good frames would speak for the whole keyframe:
// their errors come from the keyframe's depth and are not independent.
constexpr double kMaxInformation = 500.0;
// |correction of one frame| <= this, frame periods: a first one asks for 0.4 at most, see below.
constexpr double kMaxCorrection = 0.5;
// information >= this, or a keyframe says nothing: two full frames at least, deviation 0.03.
constexpr double kMinInformation = 1000.0;
// A rolling shutter of 0.6 asks for 0.1 to 0.4 at first. Moving shadows and clipped images may ask
// for as much by chance; but when that is believed, the next keyframes ask for at least 0.3 less.
// All compared with corrections in frame periods: two keyframes > each, their mean > mean, and that
// of all keyframes since the start, weighted by their information, > each: depth of another time
// asks for as much in two keyframes that show little.
constexpr double kSwitchOnEach = 0.1;
constexpr double kSwitchOnMean = 0.15;
constexpr double kRevoked = -0.25;
constexpr int kProbation = 3;  // keyframes
// The pose of each frame absorbs most of the effect, so that a correction is too small by this.
constexpr double kGain = 4.0;
// First estimate <= this, each later change <= the next, frame periods: chance that is multiplied
// by the gain does not reach further than a Kinect's read-out, and later ones approach in steps.
constexpr double kFirstLimit = 0.6;
constexpr double kStepLimit = 0.2;
// The gain falls as 1 / (1 + updates / 2), as that of a mean, to this: a slow change is followed.
constexpr double kMinGain = 0.1;
// |correction| > this, frame periods: less is no news, and would use up the gain.
constexpr double kIgnored = 0.01;
// Estimate < this: too little to matter, and to be told from none. Taken as a global shutter.
constexpr double kGlobalBelow = 0.1;
// So many products are summed in floats, then in doubles: an error of 1e-5 at most.
constexpr std::size_t kFloatSums = 128;

/// Of the pose, the read-out time and the residual.
using NormalEquations = Eigen::Matrix<double, 8, 8>;

}  // namespace

void ReadoutEstimator::add(const ReadoutMeasurement& measurement) {
  const double information = std::min(measurement.information, kMaxInformation);
  information_ += information;
  weighted_sum_ +=
      information * std::min(std::max(measurement.correction, -kMaxCorrection), kMaxCorrection);
}

void ReadoutEstimator::endKeyframe() {
  if (information_ >= kMinInformation) {
    if (!is_on_) {
      sum_while_off_ += weighted_sum_;
      information_while_off_ += information_;
    }
    decide(weighted_sum_ / information_);
  }
  weighted_sum_ = 0.0;
  information_ = 0.0;
}

void ReadoutEstimator::decide(double correction) {
  if (!is_on_) {
    const double mean = 0.5 * (correction + last_correction_);
    const double of_all = sum_while_off_ / information_while_off_;
    is_on_ = std::min({correction, last_correction_, of_all}) > caution_ * kSwitchOnEach &&
             mean > caution_ * kSwitchOnMean;
    if (is_on_) estimate_ = std::min(kFirstLimit, kGain * mean);
    last_correction_ = correction;
    keyframes_on_ = 0;
  } else if (++keyframes_on_ <= kProbation && correction < kRevoked) {
    // It was chance: back to a global shutter, and harder to convince.
    is_on_ = false;
    estimate_ = 0.0;
    last_correction_ = 0.0;
    sum_while_off_ = 0.0;
    information_while_off_ = 0.0;
    caution_ *= 2.0;
  } else if (std::abs(correction) > kIgnored) {
    const double gain = kGain * std::max(kMinGain, 1.0 / (1.0 + 0.5 * updates_));
    const double step = std::min(std::max(gain * correction, -kStepLimit), kStepLimit);
    estimate_ = std::min(std::max(estimate_ + step, 0.0), 1.0);
    ++updates_;
  }
  readout_ = estimate_ < kGlobalBelow ? 0.0 : estimate_;
}

ReadoutMeasurement measureReadout(const ReferencePoints& points, const Residuals& residuals,
                                  const std::vector<float>& live_rows, double height, double scale,
                                  const RowVelocities& velocities) {
  // A longer read-out moves a point of the keyframe, as the live image sees it, by
  // tau_live (live velocity) - tau_keyframe (keyframe velocity), both in the keyframe's axes.
  const Vector6 live = velocities.liveInKeyframe();
  Recycled<std::vector<float>> weights;
  weights->resize(points.size());
  kernels::active().robustWeights(RobustWeight::kTukey, static_cast<float>(scale),
                                  residuals.value.data(), residuals.visible.data(), points.size(),
                                  weights->data());
  NormalEquations sum = NormalEquations::Zero();
  const auto inverse_scale = static_cast<float>(1.0 / scale);
  const auto inverse_height = static_cast<float>(1.0 / height);
  const Eigen::Matrix<float, 6, 1> v_live = live.cast<float>();
  const Eigen::Matrix<float, 6, 1> v_keyframe = velocities.keyframe.cast<float>();
  for (std::size_t begin = 0; begin < points.size(); begin += kFloatSums) {
    Eigen::Matrix<float, 8, 8> part = Eigen::Matrix<float, 8, 8>::Zero();
    const std::size_t end = std::min(points.size(), begin + kFloatSums);
    for (std::size_t i = begin; i < end; ++i) {
      // Pose, read-out time and residual.
      Eigen::Matrix<float, 8, 1> J;
      for (std::size_t k = 0; k < 6; ++k) J[static_cast<int>(k)] = points.jacobian[k][i];
      const float tau_live = live_rows[i] * inverse_height - 0.5F;
      const float tau_keyframe = static_cast<float>(points.pixels[i].y) * inverse_height - 0.5F;
      J[6] = tau_keyframe * J.head<6>().dot(v_keyframe) - tau_live * J.head<6>().dot(v_live);
      J[7] = residuals.value[i];
      part.noalias() += ((*weights)[i] * J) * J.transpose();
    }
    sum += part.cast<double>();
  }
  sum *= static_cast<double>(inverse_scale * inverse_scale);
  const auto H = sum.topLeftCorner<7, 7>();
  const auto b = sum.col(7).head<7>();
  ReadoutMeasurement measurement;
  const Eigen::LDLT<Matrix6> pose(H.topLeftCorner<6, 6>());
  if (pose.info() != Eigen::Success || !pose.isPositive()) return measurement;
  const Vector6 coupling = pose.solve(H.topRightCorner<6, 1>());
  const double information = H(6, 6) - coupling.dot(H.topRightCorner<6, 1>());
  const double gradient = b[6] - coupling.dot(b.head<6>());
  if (!(information > 0.0) || !std::isfinite(gradient)) return measurement;
  measurement.correction = gradient / information;
  measurement.information = information;
  return measurement;
}

}  // namespace mivo
