// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iostream>
#include <string>

#include "evaluation/evaluation_plot.h"
#include "evaluation/report.h"
#include "mivo/io/output_file.h"
#include "programs/command_line.h"
#include "programs/output_paths.h"
#include "programs/python_plot.h"
#include "programs/trajectory_pair.h"

namespace {

namespace po = boost::program_options;

void requirePositive(const std::string& option, double value, const std::string& unit) {
  if (!std::isfinite(value) || !(value > 0.0)) {
    throw mivo::UsageError("--" + option + " must be a positive number of " + unit);
  }
}

void tell(const std::string& note) {
  if (!note.empty()) std::cerr << "evaluate_trajectory: note: " << note << "\n";
}

void run(int argc, char** argv) {
  std::string truth_path;
  std::string estimate_path;
  std::string json_path;
  std::string plot_path;
  mivo::EvaluationOptions options;
  bool force = false;
  mivo::CommandLine line(
      "evaluate_trajectory",
      "Compares an estimated trajectory with ground truth: relative pose error and "
      "absolute trajectory error.");
  line.argument(
      "TRUTH", &truth_path,
      "ground truth: TUM, EuRoC, KITTI or ROS 2 CSV; or the sequence folder that holds it (TUM, "
      "7-Scenes, ScanNet)");
  line.argument("ESTIMATE", &estimate_path, "estimated trajectory, in any of these formats");
  line.options()("delta", po::value(&options.delta)->default_value(options.delta, "1"),
                 "interval of the relative pose error, seconds")(
      "delta-meters", po::value(&options.delta_meters)->default_value(options.delta_meters, "1"),
      "interval of the relative pose error along the true path, meters")(
      "max-time-difference",
      po::value(&options.max_time_difference)->default_value(options.max_time_difference, "0.02"),
      "largest difference between the stamps of compared poses, seconds")(
      "json", po::value(&json_path)->value_name("FILE"), "also write the figures as JSON")(
      "plot", po::value(&plot_path)->value_name("FILE.png|.pdf|.svg"),
      "plot paths and errors (needs Python with matplotlib)")("force", po::bool_switch(&force),
                                                              "replace existing files");
  if (!line.parse(argc, argv)) return;
  requirePositive("delta", options.delta, "seconds");
  requirePositive("delta-meters", options.delta_meters, "meters");
  requirePositive("max-time-difference", options.max_time_difference, "seconds");
  if (!plot_path.empty()) mivo::requirePlotEnding("--plot", plot_path);
  const mivo::Overwrite overwrite = force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo;
  mivo::requireOutputs({{"--json", json_path}, {"--plot", plot_path}},
                       {{"TRUTH", truth_path}, {"ESTIMATE", estimate_path}}, overwrite);

  const mivo::TrajectoryPair files = mivo::readTrajectoryPair(truth_path, estimate_path);
  for (const std::string& notice : files.notices) tell(notice);
  const mivo::Evaluation evaluation = mivo::evaluate(files.truth, files.estimate, options);
  const std::vector<mivo::Figure> figures = figuresOf(evaluation);

  std::cout << toText(figures) << std::flush;
  tell(evaluation.notice);
  if (!json_path.empty()) mivo::OutputFile(json_path, overwrite).write(toJson(figures));
  if (!plot_path.empty()) {
    mivo::plotWithPython("plot_evaluation",
                         mivo::plotDataOf(files.truth, files.estimate, evaluation), plot_path);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("evaluate_trajectory", [&] { run(argc, argv); });
}
