// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "core/alignment/align.h"
#include "core/alignment/observability.h"
#include "core/keyframe/reference_points.h"
#include "core/terms/cost_term.h"
#include "core/terms/ssd_term.h"
#include "mivo/core/camera.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// The coarsest level that is asked for directions; still coarser ones blur away what could be
/// seen.
constexpr int kCoarsestAskedLevel = 2;
/// Below this, derivatives of two coarser images confirm nothing. Sharp edges that are oblique to
/// the pixels look as if they had texture along them, which moves with the pixels: a level above
/// the finest the correlation of that is up to 0.94.
constexpr double kLeastAgreementAbove = 0.97;

/// A finished minimization on the finest level.
struct FinishedDescent {
  const std::vector<CostTerm*>& terms;  ///< image and depth terms, evaluated at the result
  bool has_prior = false;               ///< the motion prior took part, too, and is in the Hessian
  const SsdTerm* image = nullptr;       ///< that of them whose residuals are gray levels, if any
  const ReferencePoints& points;
  const Camera& camera;  ///< of the level
  /// What the images of coarser levels say at a pose, the coarsest last; asked only where the
  /// finest leaves directions open, for blur and noise hide there what is seen above.
  std::function<void(const Eigen::Isometry3d& T_live_ref, std::vector<TermCurvature>& curvatures)>
      add_coarser;
  const PoseExpectation& expected;
  /// Gray levels per pixel: along a direction with a smaller image gradient the curvature may be
  /// caused by noise only.
  double noise_gradient = 0.0;
};

/// Finds open directions, holds the pose there at the prediction, and computes the covariance:
/// writes pose, covariance and open directions of the alignment.
void holdOpenDirections(const FinishedDescent& descent, const Parameters& parameters,
                        Alignment& alignment);

}  // namespace mivo
