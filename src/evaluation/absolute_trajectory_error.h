// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <utility>
#include <vector>

#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// The poses of two trajectories that belong together, in the order of their stamps.
struct MatchedPoses {
  Trajectory truth;
  Trajectory estimate;  ///< as many
};

/// Pairs poses one to one by nearest stamps less than `max_time_difference` s apart. Both
/// trajectories are sorted first, see sortedByStamp. Throws Error when fewer than 2 pairs are
/// found.
MatchedPoses matchPoses(const Trajectory& truth, const Trajectory& estimate,
                        double max_time_difference);

/// Whether the estimate may be scaled when it is moved onto the truth.
enum class AlignmentScale { kFixed, kFree };

/// What remains between two trajectories after one of them was moved onto the other: evo's absolute
/// pose error, "evo_ape --align", with kFree "--align --correct_scale".
struct AbsoluteTrajectoryError {
  Eigen::Isometry3d T_truth_estimate = Eigen::Isometry3d::Identity();
  double scale = 1.0;          ///< of the estimate, before it is moved
  std::vector<double> stamps;  ///< s, of the poses of the estimate that have a true one
  /// m, position of the moved estimate minus the true one, in the axes of the truth.
  std::vector<Eigen::Vector3d> differences;
  std::vector<double> rotations;  ///< rad, between the moved and the true orientation

  /// m, the lengths of the differences.
  std::vector<double> errors() const;
};

AbsoluteTrajectoryError absoluteTrajectoryError(const MatchedPoses& poses,
                                                AlignmentScale scale = AlignmentScale::kFixed);

}  // namespace mivo
