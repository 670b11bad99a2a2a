// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/open_directions.h"

#include <algorithm>
#include <cmath>

#include "core/alignment/minimize.h"
#include "core/alignment/pose_covariance.h"
#include "core/execution/recycled.h"
#include "core/symmetric.h"

namespace mivo {
namespace {

// Systematic error by interpolation, blur and the keyframe's depth, pixels: equal for all points,
// so that it does not show in the residuals.
constexpr double kModelErrorPixels = 0.05;
// Below this, derivatives of the finest images confirm nothing, see kLeastAgreementAbove: the steps
// of oblique edges correlate by up to 0.6 there, those of a few points by up to 0.75.
constexpr double kLeastAgreement = 0.7;
constexpr double kLeastAgreementOfFew = 0.8;
// On the coarsest level asked they correlate by 0.6 in one frame of a hundred, by 0.72 at most.
// What correlates by more there in all directions is texture, and what the finer levels see of it
// only noise and blur can hide.
constexpr double kAgreementOfTexture = 0.75;
// The least curvature of the finest images, of the strongest, by noise and the steps of oblique
// edges: 0.0004 at most. Where the keyframe has more it has texture, and half an agreement confirms
// that the live frame, blurred or in other light, shows it, too.
constexpr double kCurvatureOfSteps = 5e-4;
constexpr double kAgreementOfBlurredTexture = 0.45;
// Number of points for a first, fast test (0.1 ms), which suffices for most views.
constexpr std::size_t kPointsAtFirst = 1024;
// Approximate mean of the robust weights.
constexpr double kMeanWeight = 0.5;
// The minimization is repeated when holding the pose has moved the points by more than this.
constexpr double kNoticeablePixels = 0.05;

double pixelsOf(const Vector6& increment, const ReferencePoints& points) {
  return std::sqrt(std::max(0.0, increment.dot(points.pixel_motion * increment)));
}

/// Directions whose curvature could be caused by noise; all if one could be. Noise couples open
/// directions with weakly constrained ones, such as translation with rotation, so that an open
/// direction spreads over several eigenvectors of the Hessian.
std::array<bool, 6> directionsInDoubt(const Observability& seen, const FinishedDescent& descent,
                                      double least_correlation) {
  std::array<bool, 6> doubt{};
  if (descent.image == nullptr || !descent.image->isInformative() ||
      std::abs(descent.image->correlation()) < least_correlation) {
    doubt.fill(true);
    return doubt;
  }
  Vector6 scale = Vector6::Ones();
  scale.head<3>().setConstant(static_cast<double>(descent.points.median_depth));
  const double residual = descent.image->scale();
  const double per_curvature =
      residual * residual / (kMeanWeight * static_cast<double>(descent.points.size()));
  for (int i = 0; i < 6; ++i) {
    const double pixels = pixelsOf(scale.cwiseProduct(seen.axes().col(i)), descent.points);
    const double gradient = std::sqrt(std::max(0.0, seen.curvature()[i]) * per_curvature);
    if (!(gradient > descent.noise_gradient * pixels)) doubt.fill(true);
  }
  return doubt;
}

/// Covariance of the gradient with correlated residuals; the Hessian where it is not known.
/// Corrected for the six fitted degrees of freedom.
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

/// In place of what was in the list. The Hessian of all terms is known: the last one has the rest.
void findCurvatures(const FinishedDescent& descent, const Alignment& alignment,
                    std::size_t most_points, double least_agreement,
                    std::vector<TermCurvature>& curvatures) {
  curvatures.clear();
  Matrix6 rest = alignment.hessian;
  for (std::size_t i = descent.terms.size(); i-- > 0;) {
    CostTerm& term = *descent.terms[i];
    term.evaluate(alignment.T_live_ref);
    const bool is_known = i == 0 && !descent.has_prior;
    const Matrix6 hessian = is_known ? rest : term.linearize(kScaleIsKept).hessian;
    rest -= hessian;
    curvatures.push_back({hessian, term.agreement(most_points), least_agreement});
  }
}

Observability lookAt(const FinishedDescent& descent, const Matrix6& expected_covariance,
                     const Parameters& parameters, const Alignment& alignment) {
  ObservabilityInput input;
  input.gradient_covariance = gradientCovariance(descent, alignment.hessian);
  input.expected_covariance = expected_covariance;
  input.length = static_cast<double>(descent.points.median_depth);
  input.open_deviations = parameters.loss.open_deviations;
  Observability seen(alignment.hessian, input);
  const std::array<bool, 6> doubt =
      directionsInDoubt(seen, descent, parameters.loss.retry_correlation);
  if (std::none_of(doubt.begin(), doubt.end(), [](bool is_in_doubt) { return is_in_doubt; })) {
    return seen;
  }
  Recycled<std::vector<TermCurvature>> curvatures;
  Observability few = seen;
  findCurvatures(descent, alignment, kPointsAtFirst, kLeastAgreementOfFew, *curvatures);
  few.confirm(doubt, *curvatures);
  if (!few.hasOpen()) return few;
  // Before a direction is declared open, all points and the coarser levels are tested.
  findCurvatures(descent, alignment, descent.points.size(), kLeastAgreement, *curvatures);
  descent.add_coarser(alignment.T_live_ref, *curvatures);
  const bool has_texture =
      seen.curvature().minCoeff() > kCurvatureOfSteps * seen.curvature().maxCoeff();
  if (seen.leastCorrelation(curvatures->back()) >=
      (has_texture ? kAgreementOfBlurredTexture : kAgreementOfTexture)) {
    for (TermCurvature& term : *curvatures) term.least_agreement = 0.0;
  }
  seen.confirm(doubt, *curvatures);
  return seen;
}

/// Most probable increment, given the predicted pose and the result of the minimization in the
/// constrained directions.
struct Held {
  Vector6 increment = Vector6::Zero();
  Matrix6 covariance;
};

Held holdAtExpected(const PoseExpectation& expected, const Matrix6& expected_covariance,
                    const Eigen::Isometry3d& T_live_ref, const Observability& seen) {
  const Matrix6 information = symmetricSolve(expected_covariance, Matrix6(Matrix6::Identity()));
  Held held;
  held.covariance = (seen.informationOfSeen() + information).inverse();
  if (!expected.is_known) return held;
  const Vector6 to_expected = localCoordinates(expected.T_live_ref.inverse() * T_live_ref);
  held.increment = held.covariance * (information * to_expected);
  return held;
}

void seekInSeenDirections(const FinishedDescent& descent, const Matrix6& open,
                          const Parameters& parameters, Alignment& alignment) {
  const Matrix6 free = Matrix6::Identity() - open;
  alignment.T_live_ref =
      minimize(descent.terms, alignment.T_live_ref,
               static_cast<double>(descent.points.median_depth), descent.points.pixel_motion,
               parameters, 1.0, parameters.alignment.trusted_step_pixels, &free)
          .T_live_ref;
}

}  // namespace

void holdOpenDirections(const FinishedDescent& descent, const Parameters& parameters,
                        Alignment& alignment) {
  const Matrix6 expected_covariance = descent.expected.incrementCovariance();
  const Observability seen = lookAt(descent, expected_covariance, parameters, alignment);
  alignment.has_open_directions = seen.hasOpen();
  const double angle = kModelErrorPixels / descent.camera.fx;
  const Matrix6 model_error =
      diagonalCovariance(angle * static_cast<double>(descent.points.median_depth), angle);
  if (!alignment.has_open_directions) {
    alignment.covariance = seen.covarianceOfSeen() + model_error;
    return;
  }
  const Held held =
      holdAtExpected(descent.expected, expected_covariance, alignment.T_live_ref, seen);
  alignment.covariance =
      held.covariance + seen.covarianceOfDirections(held.covariance) + model_error;
  alignment.T_live_ref = orthonormalized(alignment.T_live_ref * retract(held.increment).inverse());
  if (pixelsOf(held.increment, descent.points) > kNoticeablePixels) {
    seekInSeenDirections(descent, seen.openProjector(), parameters, alignment);
  }
  alignment.open_directions = seen.openDirections(alignment.T_live_ref);
  const Matrix6 to_camera = adjoint(alignment.T_live_ref);
  alignment.open_projector = to_camera * seen.openProjector() * to_camera.inverse();
}

}  // namespace mivo
