// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "mivo/core/camera.h"
#include "mivo/core/image_pyramid.h"
#include "mivo/core/keyframe.h"
#include "mivo/core/parameters.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// Result of aligning one frame with a keyframe.
struct Alignment {
  Eigen::Isometry3d T_live_ref = Eigen::Isometry3d::Identity();
  Matrix6 information = Matrix6::Identity();  ///< of the increment at T_live_ref, nats
  double condition = 0.0;           ///< weakest over strongest curvature on the finest level
  int points = 0;                   ///< used on the finest level
  double overlap = 0.0;             ///< fraction of the finest level's points in view
  double mutual_information = 0.0;  ///< nats, on the finest level that uses it
  double residual_scale = 0.0;      ///< grey levels, on the finest SSD level
  int num_levels = 0;
  std::array<LevelRecord, kMaxLevels> levels{};  ///< coarsest first
};

/// Aligns a frame with a keyframe from the coarsest level to the finest: mutual information or SSD
/// on each, as the parameters say (Algorithm 1). A level with too few points in view is passed
/// over.
Alignment align(const Keyframe& keyframe, const ImagePyramid& live, const Camera& camera,
                const Eigen::Isometry3d& T_live_ref_start, const Parameters& parameters);

}  // namespace mivo
