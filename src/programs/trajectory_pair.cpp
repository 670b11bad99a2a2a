// SPDX-License-Identifier: BSD-3-Clause
#include "programs/trajectory_pair.h"

#include <filesystem>
#include <limits>
#include <utility>

#include "evaluation/relative_pose_error.h"
#include "evaluation/statistics.h"
#include "io/pose_folder.h"
#include "io/trajectory_format.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

// s; enough to see whether two paths turn in the same way.
constexpr double kMaxTimeDifference = 0.1;
// An order of the quaternion that is wrong is this many times worse at least.
constexpr double kFarBetter = 3.0;

/// The same numbers of a file, the first of the four taken as qw instead of the last.
Trajectory withScalarFirst(Trajectory trajectory) {
  for (StampedPose& pose : trajectory) {
    const Eigen::Quaterniond q(pose.pose.linear());
    pose.pose.linear() = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
  }
  return trajectory;
}

/// A way in which a file may be read.
struct Reading {
  Trajectory poses;
  bool is_scalar_first;
};

std::vector<Reading> readingsOf(const TrajectoryFile& file) {
  std::vector<Reading> readings = {{file.poses, false}};
  if (file.is_order_assumed) readings.push_back({withScalarFirst(file.poses), true});
  return readings;
}

/// How far the rotations from pose to pose differ, rad; infinite when none can be compared.
double disagreement(const Trajectory& truth, const Trajectory& estimate) {
  std::vector<double> rotations;
  try {
    for (const RelativePoseError& error :
         stepErrors(matchPoses(truth, estimate, kMaxTimeDifference))) {
      rotations.push_back(error.rotation);
    }
  } catch (const Error&) {
    return std::numeric_limits<double>::infinity();  // the evaluation will say why
  }
  return statisticsOf(rotations).rmse;
}

}  // namespace

TrajectoryPair readTrajectoryPair(const std::string& truth_path, const std::string& estimate_path) {
  std::error_code ignored;  // what cannot be looked at fails, with its reason, when it is read
  const TrajectoryFile truth_file = std::filesystem::is_directory(truth_path, ignored)
                                        ? readPoseFolder(truth_path)
                                        : readTrajectoryFile(truth_path);
  const TrajectoryFile estimate_file = readTrajectoryFile(estimate_path);
  TrajectoryPair best{truth_file.poses, estimate_file.poses, {}};
  double best_disagreement = disagreement(best.truth, best.estimate);
  std::vector<std::string> decisions;
  for (const Reading& truth : readingsOf(truth_file)) {
    for (const Reading& estimate : readingsOf(estimate_file)) {
      const double value = disagreement(truth.poses, estimate.poses);
      if (!(kFarBetter * value < best_disagreement)) continue;
      best_disagreement = value;
      best.truth = truth.poses;
      best.estimate = estimate.poses;
      decisions.clear();
      const char* const decision =
          ": read with qw before qx: its rotations fit the other file's so";
      if (truth.is_scalar_first) decisions.push_back(truth_path + decision);
      if (estimate.is_scalar_first) decisions.push_back(estimate_path + decision);
    }
  }
  for (const auto* notices :
       {&truth_file.notices, &estimate_file.notices, &std::as_const(decisions)}) {
    best.notices.insert(best.notices.end(), notices->begin(), notices->end());
  }
  return best;
}

}  // namespace mivo
