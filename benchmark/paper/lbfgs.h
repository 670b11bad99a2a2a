// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/terms/cost_term.h"
#include "mivo/core/parameters.h"

namespace mivo {

enum class GradientSource {
  kTerm,        ///< the term's own, which warps the keyframe and treats its image as exact
  kDifferences  ///< central differences of the cost
};

struct LbfgsResult {
  Eigen::Isometry3d T_live_ref;
  double cost = 0.0;  ///< nats
  int iterations = 0;
  int evaluations = 0;  ///< of the cost, those for differences included
  int gradients = 0;
};

/// Minimizes one term over the pose by L-BFGS of Ceres, with its defaults (Wolfe line search,
/// rank 20, 50 iterations) but the tolerance of the cost, which is `min_cost_change` as in
/// minimize(). Unknowns are p with T = T_start retract(d)^-1, d = (length * p_v, p_w): translations
/// in units of the scene's depth, so that all six count alike.
LbfgsResult minimizeByLbfgs(CostTerm& term, const Eigen::Isometry3d& T_live_ref, double length,
                            GradientSource source, const Parameters& parameters);

}  // namespace mivo
