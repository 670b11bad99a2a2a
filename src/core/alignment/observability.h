// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/terms/agreement.h"
#include "mivo/core/se3.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// Hessian of one term (nats, of the increment), and how much of it the live frame confirms.
struct TermCurvature {
  Matrix6 hessian = Matrix6::Zero();
  Agreement agreement;
  /// Directions in which the derivatives of the two frames correlate by less are not confirmed, if
  /// they are of images.
  double least_agreement = 0.0;
};

/// Quantities that decide whether a direction is open.
struct ObservabilityInput {
  Matrix6 gradient_covariance = Matrix6::Identity();  ///< of the sum of the terms, nats
  /// Of the increment, as the motion so far expects it: m and rad.
  Matrix6 expected_covariance = Matrix6::Identity();
  double length = 1.0;           ///< m, median depth, that translations are measured in
  double open_deviations = 1.0;  ///< see the parameter
};

/// Directions of the increment and how well image and depth constrain them. One eigendecomposition
/// determines which directions are open and the covariance in the others. Directions are
/// orthonormal when translation is measured in median depths.
class Observability {
 public:
  /// Directions of the raw Hessian of all terms together.
  Observability(const Matrix6& hessian, const ObservabilityInput& input);

  /// Reexamines doubtful directions: keeps only the part of each term's curvature on which keyframe
  /// and live frame agree.
  void confirm(const std::array<bool, 6>& in_doubt, const std::vector<TermCurvature>& terms);

  /// How the derivatives of keyframe and live frame correlate in the direction in which they do so
  /// least, -1..1; 0 where there are none.
  double leastCorrelation(const TermCurvature& term) const;

  /// Orthonormal columns, and the curvature along them, nats.
  const Matrix6& axes() const { return axes_; }
  const Vector6& curvature() const { return curvature_; }

  /// Open directions are determined worse than by the motion model, or by noise only.
  const std::array<bool, 6>& isOpen() const { return is_open_; }
  bool hasOpen() const;

  /// Projects increments onto the open directions along the others; zero when all are seen.
  Matrix6 openProjector() const;

  /// H⁻¹ C H⁻¹ in the directions that are seen, with the covariance C of the gradient; zero in the
  /// others.
  Matrix6 covarianceOfSeen() const;

  /// Inverse of that covariance, and of what uncertain open directions add to it, in the directions
  /// that are seen; zero in the others. Without this addition, what is seen would seem to measure
  /// motion along an open direction that is not known exactly.
  Matrix6 informationOfSeen() const;

  /// What the seen directions may have wrong because the open ones are not known exactly: a camera
  /// that has moved along an open direction has moved a little across it, too.
  /// @param covariance of the increment
  Matrix6 covarianceOfDirections(const Matrix6& covariance) const;

  /// Motions of the camera with a large component along an open direction.
  /// @param T_live_ref pose of the increments; the result is in the axes of the live camera.
  Directions openDirections(const Eigen::Isometry3d& T_live_ref) const;

 private:
  void findOpen();
  Matrix6 scaledCovarianceOfSeen() const;
  Matrix6 scaledCovarianceOfDirections(const Matrix6& scaled) const;

  Vector6 scale_;  // multiplies increments in median depths to give those in meters
  Matrix6 hessian_ = Matrix6::Zero();  // scaled, as are the other two
  Matrix6 gradient_covariance_;
  Matrix6 expected_covariance_;
  double open_deviations_;
  Matrix6 axes_ = Matrix6::Identity();
  Vector6 curvature_ = Vector6::Zero();
  std::array<bool, 6> is_open_ = {true, true, true, true, true, true};
};

}  // namespace mivo
