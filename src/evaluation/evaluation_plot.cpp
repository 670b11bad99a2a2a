// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "evaluation/stamps.h"

namespace mivo {
namespace {

constexpr double kDegreesPerRadian = 180.0 / M_PI;

/// A JSON array of numbers, all digits of them.
template <typename Items, typename Number>
std::string arrayOf(const Items& items, const Number& number) {
  std::vector<std::string> numbers;
  for (const auto& item : items) numbers.push_back(fmt::format("{:.17g}", number(item)));
  return fmt::format("[{}]", fmt::join(numbers, ","));
}

std::string pathOf(const Trajectory& trajectory) {
  const auto coordinate = [&](int axis) {
    return arrayOf(trajectory,
                   [axis](const StampedPose& pose) { return pose.pose.translation()[axis]; });
  };
  return fmt::format("{{\"x\":{},\"y\":{},\"z\":{}}}", coordinate(0), coordinate(1), coordinate(2));
}

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

std::string driftOf(const std::vector<RelativePoseError>& errors, double start) {
  return fmt::format(
      "{{\"time\":{},\"translation\":{},\"rotation\":{}}}",
      arrayOf(errors, [&](const RelativePoseError& error) { return error.stamp - start; }),
      arrayOf(errors, [](const RelativePoseError& error) { return error.translation; }),
      arrayOf(errors,
              [](const RelativePoseError& error) { return kDegreesPerRadian * error.rotation; }));
}

}  // namespace

std::string plotDataOf(const Trajectory& truth, const Trajectory& estimate,
                       const Evaluation& evaluation) {
  const AbsoluteTrajectoryError& absolute = evaluation.absolute;
  Trajectory moved = sortedByStamp(estimate);
  const double start = moved.front().stamp;
  const double duration = moved.back().stamp - start;
  const Trajectory true_part =
      during(sortedByStamp(truth), moved, evaluation.options.max_time_difference);
  for (StampedPose& pose : moved) pose.pose = absolute.T_truth_estimate * pose.pose;
  return fmt::format(
      "{{\"truth\":{},\"estimate\":{},\"absolute\":{{\"time\":{},\"error\":{},\"rmse\":{:.17g}}},"
      "\"drift\":{},\"delta\":{:.17g},\"duration\":{:.17g}}}\n",
      pathOf(true_part), pathOf(moved),
      arrayOf(absolute.stamps, [&](double stamp) { return stamp - start; }),
      arrayOf(absolute.errors(), [](double error) { return error; }),
      statisticsOf(absolute.errors()).rmse, driftOf(evaluation.drift, start),
      evaluation.options.delta, duration);
}

}  // namespace mivo
