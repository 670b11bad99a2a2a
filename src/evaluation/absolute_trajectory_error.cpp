// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/absolute_trajectory_error.h"

#include <fmt/format.h>

#include "evaluation/alignment.h"
#include "evaluation/stamps.h"
#include "mivo/core/error.h"
#include "trajectory/association.h"

namespace mivo {

AbsoluteTrajectoryError absoluteTrajectoryError(const Trajectory& truth, const Trajectory& estimate,
                                                double max_time_difference) {
  const Trajectory Q = sortedByStamp(truth);
  const Trajectory P = sortedByStamp(estimate);
  const auto pairs = associate(stampsOf(Q), stampsOf(P), max_time_difference);
  if (pairs.size() < 2) {
    throw Error(
        fmt::format("only {} of {} poses have a true pose less than {} s away: do the "
                    "files belong together, with stamps in the same time?",
                    pairs.size(), P.size(), max_time_difference));
  }
  Eigen::Matrix3Xd true_positions(3, pairs.size());
  Eigen::Matrix3Xd positions(3, pairs.size());
  AbsoluteTrajectoryError result;
  Eigen::Index column = 0;
  for (const auto& [i, j] : pairs) {
    true_positions.col(column) = Q[i].pose.translation();
    positions.col(column) = P[j].pose.translation();
    result.stamps.push_back(P[j].stamp);
    ++column;
  }
  result.T_truth_estimate = rigidAlignment(positions, true_positions);
  for (Eigen::Index i = 0; i < column; ++i) {
    const Eigen::Vector3d moved = result.T_truth_estimate * positions.col(i);
    result.errors.push_back((moved - true_positions.col(i)).norm());
  }
  return result;
}

}  // namespace mivo
