// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/keyframe/geometric_points.h"
#include "core/terms/agreement.h"
#include "mivo/core/camera.h"
#include "mivo/core/frame.h"

namespace mivo {

/// Agreement of the surface normals of at most so many points: those of the keyframe's planes with
/// those that the live depth has where the points fall.
/// @param u, @param v pixels of the points in the live image, @param visible which are seen.
Agreement depthAgreement(const GeometricPoints& points, const Frame& live, const Camera& camera,
                         const std::vector<float>& u, const std::vector<float>& v,
                         const std::vector<float>& visible, const Eigen::Isometry3d& T_live_ref,
                         std::size_t most_points);

}  // namespace mivo
