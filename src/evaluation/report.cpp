// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluation/stamps.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr double kDegreesPerRadian = 180.0 / M_PI;

double duration(const Trajectory& trajectory) {
  const auto earlier = [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; };
  const auto [first, last] = std::minmax_element(trajectory.begin(), trajectory.end(), earlier);
  return trajectory.empty() ? 0.0 : last->stamp - first->stamp;
}

Statistics translations(const std::vector<RelativePoseError>& errors) {
  std::vector<double> values;
  for (const RelativePoseError& error : errors) values.push_back(error.translation);
  return statisticsOf(values);
}

Statistics rotationsInDegrees(const std::vector<RelativePoseError>& errors) {
  std::vector<double> values;
  for (const RelativePoseError& error : errors)
    values.push_back(kDegreesPerRadian * error.rotation);
  return statisticsOf(values);
}

/// Time between two poses, s; 0 for fewer than two.
double medianGap(const Trajectory& trajectory) {
  const std::vector<double> stamps = stampsOf(sortedByStamp(trajectory));
  std::vector<double> gaps;
  for (std::size_t i = 1; i < stamps.size(); ++i) gaps.push_back(stamps[i] - stamps[i - 1]);
  return quantile(gaps, 0.5);
}

/// Each pose would be compared with itself, and have no error.
void requireDelta(const Trajectory& estimate, double delta) {
  constexpr double kRounding = 0.95;  // of one period, given with few digits
  const double period = medianGap(estimate);
  if (delta < kRounding * period) {
    throw Error(fmt::format(
        "delta is {} s, less than the {:.3g} s between two poses of the estimate: choose a larger "
        "delta",
        delta, period));
  }
  if (relativePoseErrors(estimate, estimate, delta, 0.0).empty()) {
    throw Error(
        fmt::format("the estimate lasts {:.3f} s and has no two poses {} s apart that can "
                    "be compared: choose a smaller delta",
                    duration(estimate), delta));
  }
}

void addDrift(const std::string& name, const std::vector<RelativePoseError>& errors,
              std::vector<Figure>& figures) {
  if (errors.empty()) return;
  const Statistics translation = translations(errors);
  const Statistics rotation = rotationsInDegrees(errors);
  figures.insert(figures.end(), {{name + "_translation_rmse_m", translation.rmse},
                                 {name + "_rotation_rmse_deg", rotation.rmse},
                                 {name + "_translation_median_m", translation.median},
                                 {name + "_rotation_median_deg", rotation.median},
                                 {name + "_translation_max_m", translation.max},
                                 {name + "_rotation_max_deg", rotation.max},
                                 {name + "_pairs", static_cast<double>(errors.size())}});
}

double axisRmse(const AbsoluteTrajectoryError& absolute, int axis) {
  std::vector<double> errors;
  for (const Eigen::Vector3d& difference : absolute.differences) errors.push_back(difference[axis]);
  return statisticsOf(errors).rmse;
}

}  // namespace

Evaluation evaluate(const Trajectory& truth, const Trajectory& estimate,
                    const EvaluationOptions& options) {
  Evaluation evaluation;
  evaluation.options = options;
  evaluation.frames = estimate.size();
  const MatchedPoses poses = matchPoses(truth, estimate, options.max_time_difference);
  evaluation.absolute = absoluteTrajectoryError(poses);
  evaluation.scaled = absoluteTrajectoryError(poses, AlignmentScale::kFree);
  evaluation.steps = stepErrors(poses);
  evaluation.path_drift = pathErrors(poses, options.delta_meters);
  const double true_duration = duration(truth);
  if (!(true_duration > 0.0)) throw Error("the true trajectory has no duration");
  evaluation.coverage = duration(poses.estimate) / true_duration;
  requireDelta(estimate, options.delta);
  evaluation.drift =
      relativePoseErrors(truth, estimate, options.delta, options.max_time_difference);
  if (evaluation.drift.empty()) {
    evaluation.notice = fmt::format(
        "no two poses {} s apart both have a true pose within {} s: no relative pose error over "
        "time. The true poses are {:.3g} s apart: choose --delta so",
        options.delta, options.max_time_difference, medianGap(truth));
  }
  return evaluation;
}

std::vector<Figure> figuresOf(const Evaluation& evaluation) {
  const AbsoluteTrajectoryError& absolute = evaluation.absolute;
  const std::vector<double> errors = absolute.errors();
  const Statistics distances = statisticsOf(errors);
  std::vector<Figure> figures = {
      {"frames", static_cast<double>(evaluation.frames)},
      {"coverage", evaluation.coverage},
      {"matched", static_cast<double>(errors.size()) / static_cast<double>(evaluation.frames)}};
  addDrift("rpe", evaluation.drift, figures);
  figures.push_back({"rpe_frame_translation_rmse_m", translations(evaluation.steps).rmse});
  figures.push_back({"rpe_frame_rotation_rmse_deg", rotationsInDegrees(evaluation.steps).rmse});
  if (!evaluation.path_drift.empty()) {
    const double meters = evaluation.options.delta_meters;
    addDrift("rpe_path", evaluation.path_drift, figures);
    figures.push_back({"rpe_path_translation_percent",
                       100.0 * translations(evaluation.path_drift).mean / meters});
    figures.push_back(
        {"rpe_path_rotation_deg_per_m", rotationsInDegrees(evaluation.path_drift).mean / meters});
  }
  figures.insert(
      figures.end(),
      {{"ate_rmse_m", distances.rmse},
       {"ate_mean_m", distances.mean},
       {"ate_median_m", distances.median},
       {"ate_max_m", distances.max},
       {"ate_x_rmse_m", axisRmse(absolute, 0)},
       {"ate_y_rmse_m", axisRmse(absolute, 1)},
       {"ate_z_rmse_m", axisRmse(absolute, 2)},
       {"ate_rotation_rmse_deg", kDegreesPerRadian * statisticsOf(absolute.rotations).rmse},
       {"ate_scale", evaluation.scaled.scale},
       {"ate_scaled_rmse_m", statisticsOf(evaluation.scaled.errors()).rmse},
       {"ate_pairs", static_cast<double>(errors.size())}});
  return figures;
}

std::string toText(const std::vector<Figure>& figures) {
  std::string text;
  for (const Figure& figure : figures)
    text += fmt::format("{}: {:.9g}\n", figure.name, figure.value);
  return text;
}

std::string toJson(const std::vector<Figure>& figures) {
  std::string text = "{\n";
  for (std::size_t i = 0; i < figures.size(); ++i) {
    text += fmt::format("  \"{}\": {:.9g}{}\n", figures[i].name, figures[i].value,
                        i + 1 < figures.size() ? "," : "");
  }
  return text + "}\n";
}

}  // namespace mivo
