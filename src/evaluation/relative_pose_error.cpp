// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/relative_pose_error.h"

#include <cmath>
#include <functional>

#include "evaluation/stamps.h"
#include "mivo/core/se3.h"

namespace mivo {
namespace {

/// Errors from each pose i to pose partner(i); partner and i count in the sorted estimate.
std::vector<RelativePoseError> errorsOfPairs(
    const Trajectory& truth, const Trajectory& estimate, double max_time_difference,
    const std::function<std::size_t(const std::vector<double>&, std::size_t)>& partner) {
  std::vector<RelativePoseError> errors;
  if (truth.empty()) return errors;
  const Trajectory Q = sortedByStamp(truth);
  const Trajectory P = sortedByStamp(estimate);
  const std::vector<double> true_stamps = stampsOf(Q);
  const std::vector<double> stamps = stampsOf(P);
  for (std::size_t i = 0; i < P.size(); ++i) {
    const std::size_t j = partner(stamps, i);
    if (j + 1 >= P.size()) continue;
    const StampedPose& Q_i = Q[nearestIndex(true_stamps, stamps[i])];
    const StampedPose& Q_j = Q[nearestIndex(true_stamps, stamps[j])];
    if (std::abs(Q_i.stamp - stamps[i]) > max_time_difference ||
        std::abs(Q_j.stamp - stamps[j]) > max_time_difference) {
      continue;
    }
    const Eigen::Isometry3d true_motion = Q_j.pose.inverse() * Q_i.pose;
    const Eigen::Isometry3d motion = P[j].pose.inverse() * P[i].pose;
    const Eigen::Isometry3d error = motion.inverse() * true_motion;
    errors.push_back({stamps[i], error.translation().norm(), logSo3(error.linear()).norm()});
  }
  return errors;
}

}  // namespace

std::vector<RelativePoseError> relativePoseErrors(const Trajectory& truth,
                                                  const Trajectory& estimate, double delta,
                                                  double max_time_difference) {
  return errorsOfPairs(truth, estimate, max_time_difference,
                       [delta](const std::vector<double>& stamps, std::size_t i) {
                         return nearestIndex(stamps, stamps[i] + delta);
                       });
}

std::vector<RelativePoseError> frameToFrameErrors(const Trajectory& truth,
                                                  const Trajectory& estimate,
                                                  double max_time_difference) {
  return errorsOfPairs(truth, estimate, max_time_difference,
                       [](const std::vector<double>&, std::size_t i) { return i + 1; });
}

}  // namespace mivo
