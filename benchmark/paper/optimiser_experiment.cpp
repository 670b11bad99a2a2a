// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "image_pair.h"
#include "lbfgs.h"
#include "mivo/core/cpu_clock.h"
#include "mivo/core/minimise.h"
#include "mivo/io/output_file.h"
#include "parameter_options.h"
#include "programs/command_line.h"
#include "programs/progress_bar.h"
#include "random_twist.h"

// Newton with the full Hessian, as the tracker uses it, against L-BFGS of Ceres on the same cost
// (paper, IV-B3).

namespace {

namespace po = boost::program_options;

struct Request {
  mivo::PairOptions pairs;
  std::string optimiser;
  std::vector<double> magnitudes;
  long long trials = 100;
  long long seed = 1;
  std::string output;
  bool force = false;
};

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
                const Eigen::Isometry3d& start, const std::string& optimiser,
                const mivo::Parameters& parameters) {
  Outcome outcome;
  outcome.T_live_ref = start;
  const double begin = mivo::threadMilliseconds();
  for (int l = pair.keyframe.numLevels() - 1; l >= 0; --l) {
    const mivo::KeyframeLevel& level = pair.keyframe.level(l);
    const mivo::Warp warp(camera.atLevel(l), mivo::RowMotion{}, parameters.threads);
    mivo::MiTerm term(level.points, level.mi, pair.live.informationImage(l),
                      pair.live.informationRange(l), warp, parameters);
    const auto length = static_cast<double>(level.points.median_depth);
    if (optimiser == "newton") {
      const mivo::Minimum minimum = mivo::minimise({&term}, outcome.T_live_ref, length,
                                                   level.points.pixel_motion, parameters);
      outcome.T_live_ref = minimum.T_live_ref;
      outcome.cost = minimum.cost;
      outcome.iterations += minimum.iterations;
      outcome.evaluations += minimum.evaluations;
      outcome.gradients += minimum.iterations;
    } else {
      const auto gradient =
          optimiser == "lbfgs" ? mivo::GradientSource::kTerm : mivo::GradientSource::kDifferences;
      const mivo::LbfgsResult result =
          mivo::minimiseByLbfgs(term, outcome.T_live_ref, length, gradient, parameters);
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

void validate(const Request& request) {
  if (request.output.empty()) throw mivo::UsageError("--output FILE.csv is missing");
  if (request.optimiser != "newton" && request.optimiser != "lbfgs" &&
      request.optimiser != "lbfgs_differences") {
    throw mivo::UsageError("--optimiser is newton, lbfgs or lbfgs_differences");
  }
  if (request.magnitudes.empty()) throw mivo::UsageError("--magnitude N is missing");
  for (const double magnitude : request.magnitudes) {
    if (!std::isfinite(magnitude) || magnitude < 0.0) {
      throw mivo::UsageError("--magnitude must not be negative");
    }
  }
  if (request.trials < 1) throw mivo::UsageError("--trials must be 1 at least");
  if (request.seed < 0) throw mivo::UsageError("--seed must not be negative");
}

void run(int argc, char** argv) {
  Request request;
  mivo::ParameterOptions parameter_options;
  mivo::CommandLine line("optimiser_experiment",
                         "Maximises mutual information on all levels from random starts by "
                         "Newton's method or by L-BFGS of Ceres.");
  line.argument("FOLDER", &request.pairs.reference_folder, "sequence with groundtruth.txt");
  line.options()("output", po::value(&request.output)->value_name("FILE.csv"),
                 "one row per trial (required)")(
      "optimiser", po::value(&request.optimiser)->value_name("NAME"),
      "newton; lbfgs, with the gradient that Newton uses; lbfgs_differences, with the gradient by "
      "central differences of the cost (required)")(
      "magnitude", po::value(&request.magnitudes)->composing()->value_name("N"),
      "norm of the six-vector (m, rad) by which starts are displaced; may be given several times")(
      "trials", po::value(&request.trials)->default_value(request.trials)->value_name("N"),
      "random starts per magnitude")(
      "pairs", po::value(&request.pairs.count)->default_value(request.pairs.count)->value_name("N"),
      "pairs of frames, among which the trials are shared out")(
      "gap", po::value(&request.pairs.gap)->default_value(request.pairs.gap)->value_name("N"),
      "frames from keyframe to live frame")(
      "seed", po::value(&request.seed)->default_value(request.seed)->value_name("N"),
      "other twists")("force", po::bool_switch(&request.force), "replace an existing file");
  parameter_options.declare(line);
  if (!line.parse(argc, argv)) return;
  validate(request);
  request.pairs.live_folder = request.pairs.reference_folder;

  mivo::Parameters parameters = parameter_options.parameters();
  parameters.method = mivo::Method::kMi;  // the cost in question, on every level
  const mivo::ImagePairs images = mivo::loadPairs(request.pairs, parameters);
  mivo::OutputFile file(request.output,
                        request.force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo);
  file.write(
      "magnitude,translation_m,rotation_rad,success,cost,iterations,evaluations,gradients,"
      "milliseconds\n");
  const auto trials = static_cast<std::size_t>(request.trials);
  mivo::ProgressBar progress(request.magnitudes.size() * trials);
  for (std::size_t series = 0; series < request.magnitudes.size(); ++series) {
    for (std::size_t trial = 0; trial < trials; ++trial) {
      const mivo::ImagePair& pair = images.pairs[trial % images.pairs.size()];
      const mivo::Vector6 twist = mivo::randomTwist(
          request.magnitudes[series], static_cast<std::uint64_t>(request.seed), series, trial);
      const Outcome outcome = descend(pair, images.camera, pair.T_live_ref * mivo::expSe3(twist),
                                      request.optimiser, parameters);
      const mivo::PoseDifference error = mivo::difference(outcome.T_live_ref, pair.T_live_ref);
      file.write(fmt::format("{:.6g},{:.6g},{:.6g},{},{:.6g},{},{},{},{:.4f}\n",
                             request.magnitudes[series], error.translation, error.rotation,
                             mivo::isSuccess(error) ? 1 : 0, outcome.cost, outcome.iterations,
                             outcome.evaluations, outcome.gradients, outcome.milliseconds));
      progress.advance();
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("optimiser_experiment", [&] { run(argc, argv); });
}
