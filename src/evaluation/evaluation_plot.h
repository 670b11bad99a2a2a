// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluation/report.h"
#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// What the script plot_evaluation draws of an evaluation, as JSON: both paths, the estimate moved
/// onto the truth, the errors, and how they were measured. Times (s) count from the estimate's
/// first pose. The trajectories are those the evaluation was made from; of the truth it is the part
/// during the estimate: a long recording would make the part that was tracked a dot.
std::string plotDataOf(const Trajectory& truth, const Trajectory& estimate,
                       const Evaluation& evaluation);

}  // namespace mivo
