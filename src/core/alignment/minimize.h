// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/terms/cost_term.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Result of the minimization on one level.
struct Minimum {
  Eigen::Isometry3d T_live_ref;
  double cost = 0.0;                      ///< nats, of all terms
  Matrix6 hessian = Matrix6::Zero();      ///< nats, of the last model, before the guard
  int iterations = 0;                     ///< steps taken
  int evaluations = 0;                    ///< of the cost
  double line_search_milliseconds = 0.0;  ///< processor time in evaluations after the first
};

/// Minimizes the sum of the terms over the pose: Newton steps with the definiteness guard, tried in
/// full, then halved until Armijo's condition holds (section III-B), with inverse composition T <-
/// T o retract(step)^-1 (Eq. 5). Stops on a small step or gain, or when no step reduces the cost.
/// The terms are left evaluated at the returned pose, or one untried step before it.
/// @param length median depth, m. @param pixel_motion see ReferencePoints. @param tolerance factor
/// on the step and gain that end it. @param trusted_step_pixels where the cost is convex, a shorter
/// step is accepted without a line search and ends it. @param free projects steps onto the
/// directions in which the pose may move; null: all.
Minimum minimize(const std::vector<CostTerm*>& terms, const Eigen::Isometry3d& T_live_ref,
                 double length, const Matrix6& pixel_motion, const Parameters& parameters,
                 double tolerance = 1.0, double trusted_step_pixels = 0.0,
                 const Matrix6* free = nullptr);

}  // namespace mivo
