// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "evaluation/absolute_trajectory_error.h"
#include "evaluation/relative_pose_error.h"
#include "evaluation/statistics.h"

namespace mivo {

struct EvaluationOptions {
  double delta = 1.0;                 ///< s, over which drift is measured
  double delta_meters = 1.0;          ///< m of the true path, over which it is measured, too
  double max_time_difference = 0.02;  ///< s, between a pose and the true one it is compared with
};

/// Everything that is known about an estimate when the truth is.
struct Evaluation {
  EvaluationOptions options;
  std::size_t frames = 0;                     ///< poses of the estimate
  double coverage = 0.0;                      ///< duration of the matched poses / of the truth
  std::vector<RelativePoseError> drift;       ///< over options.delta; may be empty, see notice
  std::vector<RelativePoseError> steps;       ///< from each matched pose to the next
  std::vector<RelativePoseError> path_drift;  ///< over options.delta_meters; none on shorter paths
  AbsoluteTrajectoryError absolute;
  AbsoluteTrajectoryError scaled;  ///< the scale of the estimate being free
  std::string notice;              ///< what could not be measured, and why; or empty
};

/// Throws Error when the trajectories have too few poses in common, when the estimate is shorter
/// than `delta`, or when `delta` is less than the time between two of its poses.
Evaluation evaluate(const Trajectory& truth, const Trajectory& estimate,
                    const EvaluationOptions& options);

/// One number of a report; names end with the unit.
struct Figure {
  std::string name;
  double value;
};

/// The figures in the order they are printed in.
std::vector<Figure> figuresOf(const Evaluation& evaluation);

/// Lines `name: value`.
std::string toText(const std::vector<Figure>& figures);

/// One JSON object of numbers.
std::string toJson(const std::vector<Figure>& figures);

}  // namespace mivo
