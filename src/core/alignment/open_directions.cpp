// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/open_directions.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/alignment/minimise.h"
#include "core/alignment/observability.h"
#include "core/alignment/pose_covariance.h"
#include "core/execution/recycled.h"

namespace mivo {
namespace {

// What interpolation, blur and the keyframe's depth leave of systematic error, pixels: all points
// err alike, so that no residual shows it.
constexpr double kModelErrorPixels = 0.05;
// A direction along which the keyframe's image changes by less than this, grey levels per pixel,
// may show nothing but noise: that of a camera in the dark has about half of it.
constexpr double kNoiseGradient = 4.0;
// What robust weights leave of a sum of squares, about.
constexpr double kMeanWeight = 0.5;
// The pose is sought again when holding it has moved the points by more than this.
constexpr double kNoticeablePixels = 0.05;

double pixelsOf(const Vector6& increment, const ReferencePoints& points) {
  return std::sqrt(std::max(0.0, increment.dot(points.pixel_motion * increment)));
}

/// Directions whose curvature could be that of noise.
std::array<bool, 6> directionsInDoubt(const Observability& seen, const FinishedDescent& descent) {
  std::array<bool, 6> doubt{};
  if (descent.image == nullptr || !descent.image->isInformative()) {
    doubt.fill(true);
    return doubt;
  }
  Vector6 scale = Vector6::Ones();
  scale.head<3>().setConstant(seen.length);
  const double scale_of_residuals = descent.image->scale();
  const double per_curvature = scale_of_residuals * scale_of_residuals /
                               (kMeanWeight * static_cast<double>(descent.points.size()));
  for (int i = 0; i < 6; ++i) {
    const double pixels = pixelsOf(scale.cwiseProduct(seen.axes.col(i)), descent.points);
    const double gradient = std::sqrt(std::max(0.0, seen.curvature[i]) * per_curvature);
    doubt[static_cast<std::size_t>(i)] = !(gradient > kNoiseGradient * pixels);
  }
  return doubt;
}

Observability lookAt(const FinishedDescent& descent, const Matrix6& hessian, double length,
                     double min_condition, const Eigen::Isometry3d& T_live_ref) {
  const Observability first = observe(hessian, length, min_condition);
  const std::array<bool, 6> doubt = directionsInDoubt(first, descent);
  if (std::none_of(doubt.begin(), doubt.end(), [](bool is_in_doubt) { return is_in_doubt; })) {
    return first;
  }
  Recycled<std::vector<TermCurvature>> curvatures;
  curvatures->clear();
  for (CostTerm* term : descent.terms) {
    term->evaluate(T_live_ref);
    curvatures->push_back({term->linearise(kScaleIsKept).hessian, term->agreement()});
  }
  return confirm(first, doubt, *curvatures, min_condition);
}

/// Covariance of the gradient, of residuals that err together; the Hessian stands for it where that
/// is not known. Six directions have been fitted to the blocks.
Matrix6 gradientCovariance(const FinishedDescent& descent, const Matrix6& hessian) {
  Matrix6 of_gradient = Matrix6::Zero();
  int blocks = 0;
  for (const CostTerm* term : descent.terms) {
    Matrix6 part;
    blocks = std::max(blocks, term->gradientCovariance(part));
    of_gradient += part;
  }
  if (blocks < kFewestBlocks) return hessian;
  return static_cast<double>(blocks) / (blocks - 6.0) * of_gradient;
}

/// Most probable increment for the increment to the expected pose, given that the descent's end is
/// right where it is measured.
struct Held {
  Vector6 increment = Vector6::Zero();
  Matrix6 covariance;
};

Held holdAtExpected(const PoseExpectation& expected, const Eigen::Isometry3d& T_live_ref,
                    const Matrix6& measured_information) {
  Held held;
  if (!expected.is_known) {
    held.covariance = (measured_information + Matrix6(guessCovariance().inverse())).inverse();
    return held;
  }
  const Matrix6 to_increment = adjoint(expected.T_live_ref.inverse());
  // The keyframe's own error is in both poses, and none of the increment.
  const Matrix6 covariance = positivePart(
      to_increment * expected.covariance * to_increment.transpose() - expected.keyframe_covariance);
  const Matrix6 information = covariance.ldlt().solve(Matrix6(Matrix6::Identity()));
  held.covariance = (measured_information + information).inverse();
  const Vector6 to_expected = localCoordinates(expected.T_live_ref.inverse() * T_live_ref);
  held.increment = held.covariance * (information * to_expected);
  return held;
}

void seekInSeenDirections(const FinishedDescent& descent, const Matrix6& open,
                          const Parameters& parameters, Alignment& alignment) {
  const Matrix6 free = Matrix6::Identity() - open;
  alignment.T_live_ref =
      minimise(descent.terms, alignment.T_live_ref,
               static_cast<double>(descent.points.median_depth), descent.points.pixel_motion,
               parameters, 1.0, parameters.alignment.trusted_step_pixels, &free)
          .T_live_ref;
}

}  // namespace

void holdOpenDirections(const FinishedDescent& descent, const Parameters& parameters,
                        Alignment& alignment) {
  const auto length = static_cast<double>(descent.points.median_depth);
  const Observability seen = lookAt(descent, alignment.hessian, length,
                                    parameters.loss.degraded_curvature, alignment.T_live_ref);
  const Matrix6 of_gradient = gradientCovariance(descent, alignment.hessian);
  alignment.condition = seen.condition();
  alignment.has_open_directions = seen.hasOpen();
  const double angle = kModelErrorPixels / descent.camera.fx;
  const Matrix6 model_error = diagonalCovariance(angle * length, angle);
  if (!alignment.has_open_directions) {
    alignment.covariance = seen.covarianceOfSeen(of_gradient) + model_error;
    return;
  }
  const Held held =
      holdAtExpected(descent.expected, alignment.T_live_ref, seen.informationOfSeen(of_gradient));
  alignment.covariance = held.covariance + model_error;
  alignment.T_live_ref = orthonormalised(alignment.T_live_ref * retract(held.increment).inverse());
  if (pixelsOf(held.increment, descent.points) > kNoticeablePixels) {
    seekInSeenDirections(descent, seen.openProjector(), parameters, alignment);
  }
  alignment.open_directions = openDirections(seen, alignment.T_live_ref);
  const Matrix6 to_camera = adjoint(alignment.T_live_ref);
  alignment.open_projector = to_camera * seen.openProjector() * to_camera.inverse();
}

}  // namespace mivo
