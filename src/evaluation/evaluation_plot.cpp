// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation_plot.h"

#include <fmt/format.h>

#include <cmath>

#include "evaluation/plot_panel.h"
#include "evaluation/stamps.h"

namespace mivo {
namespace {

constexpr int kWidth = 1500;  // pixels
constexpr int kHeight = 1020;
constexpr double kDegreesPerRadian = 180.0 / M_PI;

// Light and thick below dark and thin: apart in grey, and on top of each other.
const cv::Scalar kTruthColour(170, 190, 200);
const cv::Scalar kEstimateColour(120, 40, 20);
constexpr int kTruthThickness = 4;

Curve pathOf(const Trajectory& trajectory, const Eigen::Isometry3d& T, int vertical_axis) {
  Curve curve;
  for (const StampedPose& pose : trajectory) {
    const Eigen::Vector3d position = T * pose.pose.translation();
    curve.x.push_back(position.x());
    curve.y.push_back(position[vertical_axis]);
  }
  return curve;
}

void drawPaths(cv::Mat& canvas, const cv::Rect& area, const Trajectory& truth,
               const Trajectory& estimate, const Eigen::Isometry3d& T_truth_estimate,
               int vertical_axis) {
  const std::string axis(1, "xyz"[vertical_axis]);
  Curve true_path = pathOf(truth, Eigen::Isometry3d::Identity(), vertical_axis);
  true_path.name = "truth";
  true_path.colour = kTruthColour;
  true_path.thickness = kTruthThickness;
  Curve path = pathOf(estimate, T_truth_estimate, vertical_axis);
  path.name = "estimate, aligned";
  path.colour = kEstimateColour;
  drawPanel(canvas, area, {"Path, x-" + axis + " plane", "x (m)", axis + " (m)"},
            PanelScale::kEqualAxes, {true_path, path});
}

Curve errorCurve(const std::vector<RelativePoseError>& errors, double start, bool rotation) {
  Curve curve;
  curve.colour = kEstimateColour;
  for (const RelativePoseError& error : errors) {
    curve.x.push_back(error.stamp - start);
    curve.y.push_back(rotation ? kDegreesPerRadian * error.rotation : error.translation);
  }
  return curve;
}

/// The poses of the truth from shortly before the estimate to shortly after: a long recording would
/// make the part that was tracked a dot.
Trajectory during(const Trajectory& truth, const Trajectory& estimate, double margin) {
  Trajectory part;
  for (const StampedPose& pose : truth) {
    if (pose.stamp >= estimate.front().stamp - margin &&
        pose.stamp <= estimate.back().stamp + margin) {
      part.push_back(pose);
    }
  }
  return part;
}

}  // namespace

cv::Mat drawEvaluation(const Trajectory& truth, const Trajectory& estimate,
                       const Evaluation& evaluation) {
  const EvaluationOptions& options = evaluation.options;
  const Trajectory sorted_estimate = sortedByStamp(estimate);
  const Trajectory sorted_truth =
      during(sortedByStamp(truth), sorted_estimate, options.max_time_difference);
  const double start = sorted_estimate.front().stamp;
  cv::Mat canvas(kHeight, kWidth, CV_8UC3, cv::Scalar::all(255));

  const int half = kWidth / 2;
  for (const int axis : {1, 2}) {
    drawPaths(canvas, {0, (axis - 1) * kHeight / 2, half, kHeight / 2}, sorted_truth,
              sorted_estimate, evaluation.absolute.T_truth_estimate, axis);
  }

  const std::vector<double> times = {0.0, sorted_estimate.back().stamp - start};
  Curve absolute;
  absolute.colour = kEstimateColour;
  for (const double stamp : evaluation.absolute.stamps) absolute.x.push_back(stamp - start);
  absolute.y = evaluation.absolute.errors;
  const int third = kHeight / 3;
  drawPanel(canvas, {half, 0, half, third},
            {fmt::format("Absolute trajectory error, rmse {:.4g} m",
                         statisticsOf(evaluation.absolute.errors).rmse),
             "time (s)", "position (m)"},
            PanelScale::kFree, {absolute}, times);
  drawPanel(canvas, {half, third, half, third},
            {fmt::format("Relative pose error over {:g} s, translation", options.delta), "time (s)",
             "drift (m)"},
            PanelScale::kFree, {errorCurve(evaluation.drift, start, false)}, times);
  drawPanel(canvas, {half, 2 * third, half, third},
            {fmt::format("Relative pose error over {:g} s, rotation", options.delta), "time (s)",
             "drift (deg)"},
            PanelScale::kFree, {errorCurve(evaluation.drift, start, true)}, times);
  return canvas;
}

}  // namespace mivo
