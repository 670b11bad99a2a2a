// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iostream>
#include <string>

#include "evaluation/evaluation_plot.h"
#include "evaluation/report.h"
#include "io/png_file.h"
#include "mivo/io/output_file.h"
#include "mivo/io/trajectory_io.h"
#include "programs/command_line.h"

namespace {

namespace po = boost::program_options;

void requirePositive(const char* option, double value) {
  if (!std::isfinite(value) || !(value > 0.0)) {
    throw mivo::UsageError("--" + std::string(option) + " must be a positive number of seconds");
  }
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
  line.argument("TRUTH", &truth_path, "ground truth, lines 'stamp tx ty tz qx qy qz qw'");
  line.argument("ESTIMATE", &estimate_path, "estimated trajectory, in the same format");
  line.options()("delta", po::value(&options.delta)->default_value(options.delta, "1"),
                 "interval of the relative pose error, seconds")(
      "max-time-difference",
      po::value(&options.max_time_difference)->default_value(options.max_time_difference, "0.02"),
      "largest difference between the stamps of compared poses, seconds")(
      "json", po::value(&json_path)->value_name("FILE"), "also write the figures as JSON")(
      "plot", po::value(&plot_path)->value_name("FILE.png"), "plot paths and errors")(
      "force", po::bool_switch(&force), "replace existing files");
  if (!line.parse(argc, argv)) return;
  requirePositive("delta", options.delta);
  requirePositive("max-time-difference", options.max_time_difference);

  const mivo::Trajectory truth = mivo::readTrajectory(truth_path);
  const mivo::Trajectory estimate = mivo::readTrajectory(estimate_path);
  const mivo::Evaluation evaluation = mivo::evaluate(truth, estimate, options);
  const std::vector<mivo::Figure> figures = figuresOf(evaluation);

  const mivo::Overwrite overwrite = force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo;
  if (!json_path.empty()) mivo::refuseExisting(json_path, overwrite);
  if (!plot_path.empty()) mivo::refuseExisting(plot_path, overwrite);
  std::cout << toText(figures) << std::flush;
  if (!json_path.empty()) mivo::OutputFile(json_path, overwrite).write(toJson(figures));
  if (!plot_path.empty()) {
    mivo::writePng(plot_path, mivo::drawEvaluation(truth, estimate, evaluation), overwrite);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("evaluate_trajectory", [&] { run(argc, argv); });
}
