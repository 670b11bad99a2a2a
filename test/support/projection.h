// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "mivo/core/camera.h"

namespace mivo::testing {

/// Pixel of a point in the optical frame, meters, in doubles: what the kernels are compared with.
/// Empty for a point behind the camera or outside of the lens' range. The pixel may lie outside
/// of the image.
inline std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& point) {
  if (!(point.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d normalized = point.head<2>() / point.z();
  if (normalized.norm() > camera.lensRange().undistorted) return std::nullopt;
  const Eigen::Vector2d distorted = camera.distort(normalized);
  return Eigen::Vector2d(camera.fx * distorted.x() + camera.cx,
                         camera.fy * distorted.y() + camera.cy);
}

}  // namespace mivo::testing
