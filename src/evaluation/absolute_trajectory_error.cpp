// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/absolute_trajectory_error.h"

#include <fmt/format.h>

#include "evaluation/alignment.h"
#include "evaluation/stamps.h"
#include "mivo/core/error.h"
#include "mivo/core/se3.h"
#include "trajectory/association.h"

namespace mivo {
namespace {

Eigen::Matrix3Xd positionsOf(const Trajectory& trajectory) {
  Eigen::Matrix3Xd positions(3, trajectory.size());
  Eigen::Index column = 0;
  for (const StampedPose& pose : trajectory) positions.col(column++) = pose.pose.translation();
  return positions;
}

}  // namespace

MatchedPoses matchPoses(const Trajectory& truth, const Trajectory& estimate,
                        double max_time_difference) {
  const Trajectory Q = sortedByStamp(truth);
  const Trajectory P = sortedByStamp(estimate);
  MatchedPoses poses;
  for (const auto& [i, j] : associate(stampsOf(Q), stampsOf(P), max_time_difference)) {
    poses.truth.push_back(Q[i]);
    poses.estimate.push_back(P[j]);
  }
  if (poses.truth.size() < 2) {
    throw Error(
        fmt::format("only {} of {} poses have a true pose less than {} s away: do the "
                    "files belong together, with stamps in the same time?",
                    poses.truth.size(), P.size(), max_time_difference));
  }
  return poses;
}

std::vector<double> AbsoluteTrajectoryError::errors() const {
  std::vector<double> lengths;
  for (const Eigen::Vector3d& difference : differences) lengths.push_back(difference.norm());
  return lengths;
}

AbsoluteTrajectoryError absoluteTrajectoryError(const MatchedPoses& poses, AlignmentScale scale) {
  const Eigen::Matrix3Xd positions = positionsOf(poses.estimate);
  const Eigen::Matrix3Xd true_positions = positionsOf(poses.truth);
  AbsoluteTrajectoryError result;
  if (scale == AlignmentScale::kFree) result.scale = similarityScale(positions, true_positions);
  result.T_truth_estimate = rigidAlignment(result.scale * positions, true_positions);
  for (std::size_t i = 0; i < poses.truth.size(); ++i) {
    const StampedPose& P = poses.estimate[i];
    const StampedPose& Q = poses.truth[i];
    const Eigen::Vector3d moved =
        result.T_truth_estimate * Eigen::Vector3d(result.scale * P.pose.translation());
    result.stamps.push_back(P.stamp);
    result.differences.push_back(moved - Q.pose.translation());
    result.rotations.push_back(
        logSo3(Q.pose.linear().transpose() * result.T_truth_estimate.linear() * P.pose.linear())
            .norm());
  }
  return result;
}

}  // namespace mivo
