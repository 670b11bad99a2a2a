// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/terms/cost_term.h"

namespace mivo {

/// The Newton step of a model after its Hessian has been made positive definite.
struct NewtonStep {
  Vector6 step = Vector6::Zero();
  double promised_gain = 0.0;  ///< -gradient . step, positive: slope of the cost along the step
  Matrix6 guarded_hessian = Matrix6::Identity();  ///< used for the step
  bool is_convex = false;                         ///< the guard changed nothing
};

/// Guard: with translations measured in `length` (m, the median depth), each curvature that is
/// negative or weaker than `min_curvature` of the strongest one is replaced by its magnitude, or
/// that bound. The guarded Hessian must not be used for a covariance.
NewtonStep newtonStep(const QuadraticModel& model, double length, double min_curvature);

}  // namespace mivo
