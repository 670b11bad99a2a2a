// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// Distances between the positions of two trajectories after one of them was moved onto the other.
struct AbsoluteTrajectoryError {
  Eigen::Isometry3d T_truth_estimate = Eigen::Isometry3d::Identity();  ///< rigid, no scale
  std::vector<double> stamps;  ///< s, of the poses of the estimate that have a true one
  std::vector<double> errors;  ///< m, one for each
};

/// Poses are paired one to one by nearest stamps less than `max_time_difference` s apart, as the
/// tool of the TUM benchmark does it. Both trajectories are sorted first, see sortedByStamp. Throws
/// Error when fewer than 2 pairs are found.
AbsoluteTrajectoryError absoluteTrajectoryError(const Trajectory& truth, const Trajectory& estimate,
                                                double max_time_difference);

}  // namespace mivo
