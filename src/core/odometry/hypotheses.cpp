// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/hypotheses.h"

#include <algorithm>
#include <cmath>

#include "core/alignment/pose_covariance.h"
#include "core/symmetric.h"

namespace mivo {
namespace {

// So many points of an image are worth one independent pair of gray levels: neighbors share what
// light, blur and depth err.
constexpr double kPointsPerPair = 64.0;
// Correlations beyond this say nothing more.
constexpr double kLargestCorrelation = 0.999;
// Student's t of three degrees of freedom in six dimensions: tails as heavy as those of hands.
constexpr double kDegreesOfFreedom = 3.0;
constexpr double kDimensions = 6.0;
// nats: of two explanations one is twenty times as likely.
constexpr double kClearlyBetter = 3.0;
// Of a chi square of six degrees of freedom 1 % are larger.
constexpr double kElsewhere = 16.8;

Eigen::Isometry3d poseOf(const SearchInput& input, const Sight& sight) {
  return input.keyframes.at(sight.keyframe).T_odom_keyframe * sight.alignment.T_live_ref.inverse();
}

Matrix6 covarianceOf(const Sight& sight) {
  return liveCovariance(sight.alignment.T_live_ref, sight.alignment.covariance, Matrix6::Zero());
}

double chiSquare(const Vector6& difference, const Matrix6& covariance) {
  return difference.dot(symmetricSolve(covariance, difference));
}

}  // namespace

double innovation(const SearchInput& input, const Prediction& prediction, const Sight& sight) {
  const Vector6 difference =
      localCoordinates(prediction.T_odom_camera.inverse() * poseOf(input, sight));
  return chiSquare(difference, prediction.covariance + covarianceOf(sight));
}

double evidence(const SearchInput& input, const Prediction& prediction, const Sight& sight) {
  const double correlation = std::clamp(sight.alignment.correlation, 0.0, kLargestCorrelation);
  const double pairs = sight.alignment.points / kPointsPerPair;
  const double of_image = -0.5 * pairs * std::log(1.0 - correlation * correlation);
  const double surprise = innovation(input, prediction, sight);
  const double of_motion =
      -0.5 * (kDegreesOfFreedom + kDimensions) * std::log1p(surprise / kDegreesOfFreedom);
  return of_image + of_motion;
}

bool isAmbiguous(const SearchInput& input, const Prediction& prediction, const Sight& better,
                 const Sight& other) {
  if (evidence(input, prediction, better) - evidence(input, prediction, other) > kClearlyBetter) {
    return false;
  }
  const Vector6 difference =
      localCoordinates(poseOf(input, better).inverse() * poseOf(input, other));
  return chiSquare(difference, covarianceOf(better) + covarianceOf(other)) > kElsewhere;
}

Sight coveringBoth(const SearchInput& input, const Sight& better, const Sight& other) {
  Sight both = better;
  both.is_ambiguous = true;
  // The increment moves the keyframe's points before the pose is applied.
  const Eigen::Isometry3d T_keyframe_odom =
      input.keyframes.at(better.keyframe).T_odom_keyframe.inverse();
  const Vector6 difference =
      localCoordinates(T_keyframe_odom * poseOf(input, better) * poseOf(input, other).inverse() *
                       T_keyframe_odom.inverse());
  both.alignment.covariance += difference * difference.transpose();
  return both;
}

}  // namespace mivo
