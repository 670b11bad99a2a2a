// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

}  // namespace

Evaluation evaluate(const Trajectory& truth, const Trajectory& estimate,
                    const EvaluationOptions& options) {
  Evaluation evaluation;
  evaluation.options = options;
  evaluation.frames = estimate.size();
  evaluation.absolute = absoluteTrajectoryError(truth, estimate, options.max_time_difference);
  const double true_duration = duration(truth);
  if (!(true_duration > 0.0)) throw Error("the true trajectory has no duration");
  evaluation.coverage = duration(estimate) / true_duration;
  evaluation.drift =
      relativePoseErrors(truth, estimate, options.delta, options.max_time_difference);
  evaluation.frame_to_frame = frameToFrameErrors(truth, estimate, options.max_time_difference);
  if (evaluation.drift.empty()) {
    throw Error(
        fmt::format("the estimate lasts {:.3f} s and has no two poses {} s apart that can "
                    "be compared: choose a smaller delta",
                    duration(estimate), options.delta));
  }
  if (evaluation.frame_to_frame.empty()) {
    throw Error("no two successive poses of the estimate have true poses near them in time");
  }
  return evaluation;
}

std::vector<Figure> figuresOf(const Evaluation& evaluation) {
  const Statistics translation = translations(evaluation.drift);
  const Statistics rotation = rotationsInDegrees(evaluation.drift);
  const Statistics absolute = statisticsOf(evaluation.absolute.errors);
  return {{"frames", static_cast<double>(evaluation.frames)},
          {"coverage", evaluation.coverage},
          {"rpe_translation_rmse_m", translation.rmse},
          {"rpe_rotation_rmse_deg", rotation.rmse},
          {"rpe_translation_median_m", translation.median},
          {"rpe_rotation_median_deg", rotation.median},
          {"rpe_translation_max_m", translation.max},
          {"rpe_rotation_max_deg", rotation.max},
          {"rpe_pairs", static_cast<double>(evaluation.drift.size())},
          {"rpe_frame_translation_rmse_m", translations(evaluation.frame_to_frame).rmse},
          {"rpe_frame_rotation_rmse_deg", rotationsInDegrees(evaluation.frame_to_frame).rmse},
          {"ate_rmse_m", absolute.rmse},
          {"ate_max_m", absolute.max},
          {"ate_pairs", static_cast<double>(evaluation.absolute.errors.size())}};
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
