// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "core/alignment/minimize.h"
#include "core/execution/cpu_clock.h"
#include "lbfgs.h"
#include "pair_experiment.h"
#include "random_twist.h"

// Newton with the full Hessian, as the tracker uses it, against L-BFGS of Ceres on the same cost
// (paper, IV-B3).

namespace {

namespace po = boost::program_options;

struct Outcome {
  Eigen::Isometry3d T_live_ref;
  double cost = 0.0;  // nats, of the finest level
  int iterations = 0;
  int evaluations = 0;  // of the cost
  int gradients = 0;
  double milliseconds = 0.0;
};

/// Down the pyramid by mutual information on each level.
Outcome descend(const mivo::ImagePair& pair, const mivo::Camera& camera,
                const Eigen::Isometry3d& start, const std::string& optimizer,
                const mivo::Parameters& parameters) {
  Outcome outcome;
  outcome.T_live_ref = start;
  const double begin = mivo::threadMilliseconds();
  for (int l = pair.keyframe.numLevels() - 1; l >= 0; --l) {
    const mivo::KeyframeLevel& level = pair.keyframe.level(l);
    const mivo::Warp warp(camera.atLevel(l), mivo::RowMotion{}, parameters.alignment.threads);
    mivo::MiTerm term(level.points, level.mi, pair.live.miImage(l), pair.live.miRange(l), warp,
                      parameters);
    const auto length = static_cast<double>(level.points.median_depth);
    if (optimizer == "newton") {
      const mivo::Minimum minimum = mivo::minimize({&term}, outcome.T_live_ref, length,
                                                   level.points.pixel_motion, parameters);
      outcome.T_live_ref = minimum.T_live_ref;
      outcome.cost = minimum.cost;
      outcome.iterations += minimum.iterations;
      outcome.evaluations += minimum.evaluations;
      outcome.gradients += minimum.iterations;
    } else {
      const auto gradient =
          optimizer == "lbfgs" ? mivo::GradientSource::kTerm : mivo::GradientSource::kDifferences;
      const mivo::LbfgsResult result =
          mivo::minimizeByLbfgs(term, outcome.T_live_ref, length, gradient, parameters);
      outcome.T_live_ref = result.T_live_ref;
      outcome.cost = result.cost;
      outcome.iterations += result.iterations;
      outcome.evaluations += result.evaluations;
      outcome.gradients += result.gradients;
    }
  }
  outcome.milliseconds = mivo::threadMilliseconds() - begin;
  return outcome;
}

void validate(const std::string& optimizer) {
  if (optimizer != "newton" && optimizer != "lbfgs" && optimizer != "lbfgs_differences") {
    throw mivo::UsageError("--optimizer is newton, lbfgs or lbfgs_differences");
  }
}

void run(int argc, char** argv) {
  mivo::PairExperiment experiment(100);
  std::string optimizer;
  mivo::CommandLine line("optimizer_experiment",
                         "Maximizes mutual information on all levels from random starts by "
                         "Newton's method or by L-BFGS of Ceres.");
  experiment.declare(line, "one row per trial");
  line.options()(
      "optimizer", po::value(&optimizer)->value_name("NAME"),
      "newton; lbfgs, with the gradient that Newton uses; lbfgs_differences, with the gradient by "
      "central differences of the cost (required)");
  if (!line.parse(argc, argv)) return;
  experiment.validate();
  validate(optimizer);

  mivo::Parameters parameters = experiment.parameters();
  parameters.alignment.method = mivo::Method::kMi;  // the cost in question, on every level
  const mivo::ImagePairs images = experiment.loadPairs(parameters);
  mivo::OutputFile file = experiment.openOutput();
  file.write(
      "magnitude,translation_m,rotation_rad,success,cost,iterations,evaluations,gradients,"
      "milliseconds\n");
  mivo::ProgressBar progress = experiment.progressBar();
  for (std::size_t series = 0; series < experiment.magnitudes().size(); ++series) {
    const double magnitude = experiment.magnitudes()[series];
    experiment.run(
        images, series, progress, [&](const mivo::ImagePair& pair, const Eigen::Isometry3d& start) {
          const Outcome outcome = descend(pair, images.camera, start, optimizer, parameters);
          const mivo::PoseDifference error = mivo::difference(outcome.T_live_ref, pair.T_live_ref);
          file.write(fmt::format("{:.6g},{:.6g},{:.6g},{},{:.6g},{},{},{},{:.4f}\n", magnitude,
                                 error.translation, error.rotation, mivo::isSuccess(error) ? 1 : 0,
                                 outcome.cost, outcome.iterations, outcome.evaluations,
                                 outcome.gradients, outcome.milliseconds));
        });
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("optimizer_experiment", [&] { run(argc, argv); });
}
