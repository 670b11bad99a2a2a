// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "evaluation/report.h"
#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// Draws an evaluation: on the left both paths, the estimate moved onto the truth, in the world's
/// x-y and x-z planes; on the right the errors over time. CV_8UC3, white paper. The trajectories
/// are those the evaluation was made from.
cv::Mat drawEvaluation(const Trajectory& truth, const Trajectory& estimate,
                       const Evaluation& evaluation);

}  // namespace mivo
