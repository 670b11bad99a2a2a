// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/terms/agreement.h"
#include "mivo/core/se3.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// What one term knows about the pose: its Hessian (nats, of the increment), and how much of it the
/// live frame confirms.
struct TermCurvature {
  Matrix6 hessian = Matrix6::Zero();
  Agreement agreement;
};

/// The directions of the increment by what image and depth say about them. One spectrum decides
/// what is open and how sure the pose is in the others. Directions are orthonormal when translation
/// is measured in median depths.
struct Observability {
  Matrix6 axes = Matrix6::Identity();   ///< columns, in that measure
  Vector6 curvature = Vector6::Zero();  ///< along them: of noise nothing is left in it, nats
  std::array<bool, 6> is_open = {true, true, true, true, true, true};
  double length = 1.0;  ///< m, median depth

  bool hasOpen() const;
  /// Weakest over strongest curvature.
  double condition() const;
  /// Projects increments onto the open directions along the others: zero when all are seen.
  Matrix6 openProjector() const;
  /// H⁻¹ C H⁻¹ in the directions that are seen, with the covariance C of the gradient; zero in the
  /// others.
  Matrix6 covarianceOfSeen(const Matrix6& of_gradient) const;
  /// Its inverse there, zero in the others.
  Matrix6 informationOfSeen(const Matrix6& of_gradient) const;
};

/// Directions of the raw Hessian of all terms together. Open is what has less than `min_condition`
/// of the strongest curvature.
Observability observe(const Matrix6& hessian, double length, double min_condition);

/// Looks again at those directions of `first` that are in doubt: keeps of each term's curvature in
/// them what keyframe and live frame agree on. @param in_doubt by direction of `first`.
Observability confirm(const Observability& first, const std::array<bool, 6>& in_doubt,
                      const std::vector<TermCurvature>& terms, double min_condition);

/// Which motions of the camera lie in the open directions: those that have a large part in one.
/// @param T_live_ref the increments' pose: they are told in the axes of the live camera.
Directions openDirections(const Observability& observability, const Eigen::Isometry3d& T_live_ref);

}  // namespace mivo
