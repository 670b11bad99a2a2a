// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/relative_pose_error.h"

#include <cmath>
#include <cstddef>
#include <optional>

#include "evaluation/stamps.h"
#include "mivo/core/se3.h"

namespace mivo {
namespace {

RelativePoseError measure(double stamp, const Eigen::Isometry3d& error) {
  return {stamp, error.translation().norm(), logSo3(error.linear()).norm()};
}

/// Between the matched poses i and j, in the order of the paper.
RelativePoseError errorBetween(const MatchedPoses& poses, std::size_t i, std::size_t j) {
  const Trajectory& Q = poses.truth;
  const Trajectory& P = poses.estimate;
  const Eigen::Isometry3d true_motion = Q[i].pose.inverse() * Q[j].pose;
  const Eigen::Isometry3d motion = P[i].pose.inverse() * P[j].pose;
  return measure(P[i].stamp, true_motion.inverse() * motion);
}

}  // namespace

std::vector<RelativePoseError> relativePoseErrors(const Trajectory& truth,
                                                  const Trajectory& estimate, double delta,
                                                  double max_time_difference) {
  std::vector<RelativePoseError> errors;
  if (truth.empty()) return errors;
  const Trajectory Q = sortedByStamp(truth);
  const Trajectory P = sortedByStamp(estimate);
  const std::vector<double> true_stamps = stampsOf(Q);
  const std::vector<double> stamps = stampsOf(P);
  for (std::size_t i = 0; i < P.size(); ++i) {
    const std::size_t j = nearestIndex(stamps, stamps[i] + delta);
    if (j == i || j + 1 >= P.size()) continue;
    const std::size_t true_i = nearestIndex(true_stamps, stamps[i]);
    const std::size_t true_j = nearestIndex(true_stamps, stamps[j]);
    if (true_i == true_j || std::abs(true_stamps[true_i] - stamps[i]) > max_time_difference ||
        std::abs(true_stamps[true_j] - stamps[j]) > max_time_difference) {
      continue;
    }
    const Eigen::Isometry3d true_motion = Q[true_j].pose.inverse() * Q[true_i].pose;
    const Eigen::Isometry3d motion = P[j].pose.inverse() * P[i].pose;
    errors.push_back(measure(stamps[i], motion.inverse() * true_motion));
  }
  return errors;
}

std::vector<RelativePoseError> stepErrors(const MatchedPoses& poses) {
  std::vector<RelativePoseError> errors;
  for (std::size_t i = 1; i < poses.truth.size(); ++i) {
    errors.push_back(errorBetween(poses, i - 1, i));
  }
  return errors;
}

std::vector<RelativePoseError> pathErrors(const MatchedPoses& poses, double delta) {
  std::vector<RelativePoseError> errors;
  std::optional<std::size_t> begin;
  double path = 0.0;
  for (std::size_t i = 1; i < poses.truth.size(); ++i) {
    path += (poses.truth[i].pose.translation() - poses.truth[i - 1].pose.translation()).norm();
    if (path < delta) continue;
    if (begin) errors.push_back(errorBetween(poses, *begin, i));
    begin = i;
    path = 0.0;
  }
  return errors;
}

}  // namespace mivo
