// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "evaluation/evaluation_plot.h"

namespace mivo {
namespace {

Trajectory straight(int count, double start) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    StampedPose pose;
    pose.stamp = start + i;
    pose.pose.translation() << 0.5 * i, 0.0, 2.0;
    trajectory.push_back(pose);
  }
  return trajectory;
}

TEST(EvaluationPlotTest, DataAreThePathsAndTheErrors) {
  // The truth is a meter higher and lasts longer; the estimate has no error otherwise.
  Trajectory truth = straight(6, 10.0);
  for (StampedPose& pose : truth) pose.pose.translation().z() += 1.0;
  Trajectory estimate = straight(4, 10.0);
  estimate[1].pose.translation().y() = 0.5;
  estimate[2].pose.translation().y() = -0.5;
  Evaluation evaluation = evaluate(truth, estimate, {});
  evaluation.absolute = {};
  evaluation.absolute.T_truth_estimate.translation().z() = 1.0;
  evaluation.absolute.stamps = {10.0, 12.0};
  evaluation.absolute.differences = {{0.0, 3.0, 4.0}, {0.0, 0.0, 5.0}};
  evaluation.drift = {{11.0, 0.25, M_PI / 2}};
  EXPECT_EQ(plotDataOf(truth, estimate, evaluation),
            "{\"truth\":{\"x\":[0,0.5,1,1.5],\"y\":[0,0,0,0],\"z\":[3,3,3,3]},"
            "\"estimate\":{\"x\":[0,0.5,1,1.5],\"y\":[0,0.5,-0.5,0],\"z\":[3,3,3,3]},"
            "\"absolute\":{\"time\":[0,2],\"error\":[5,5],\"rmse\":5},"
            "\"drift\":{\"time\":[1],\"translation\":[0.25],\"rotation\":[90]},"
            "\"delta\":1,\"duration\":3}\n");
}

}  // namespace
}  // namespace mivo
