// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace mivo {

/// Pose of the color optical frame in the world at a time: maps camera to world coordinates, m.
struct StampedPose {
  double stamp = 0.0;  ///< s
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

using Trajectory = std::vector<StampedPose>;

}  // namespace mivo
