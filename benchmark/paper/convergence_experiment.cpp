// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "image_pair.h"
#include "mivo/core/cpu_clock.h"
#include "mivo/core/tracker.h"
#include "mivo/io/output_file.h"
#include "parameter_options.h"
#include "programs/command_line.h"
#include "programs/progress_bar.h"
#include "random_twist.h"

// How far from the truth a method may start (paper, IV-B2 and Fig. 3).

namespace {

namespace po = boost::program_options;

struct Request {
  mivo::PairOptions pairs;
  std::vector<double> magnitudes;
  long long trials = 1000;
  long long seed = 1;
  std::string output;
  bool force = false;
};

struct Tally {
  long long successes = 0;
  long long iterations = 0;
  double milliseconds = 0.0;
};

Tally runTrials(const mivo::ImagePairs& images, const mivo::Parameters& parameters,
                const Request& request, std::size_t series, mivo::ProgressBar& progress) {
  Tally tally;
  for (long long trial = 0; trial < request.trials; ++trial) {
    const auto number = static_cast<std::size_t>(trial);
    const mivo::ImagePair& pair = images.pairs[number % images.pairs.size()];
    const mivo::Vector6 twist = mivo::randomTwist(
        request.magnitudes[series], static_cast<std::uint64_t>(request.seed), series, number);
    const Eigen::Isometry3d start = pair.T_live_ref * mivo::expSe3(twist);
    const double begin = mivo::threadMilliseconds();
    const mivo::Alignment alignment =
        mivo::align({pair.keyframe, pair.live, images.camera, start, start}, parameters);
    tally.milliseconds += mivo::threadMilliseconds() - begin;
    for (int l = 0; l < alignment.num_levels; ++l) {
      tally.iterations += alignment.levels[static_cast<std::size_t>(l)].iterations;
    }
    // What is not finite is no success.
    if (mivo::isSuccess(mivo::difference(alignment.T_live_ref, pair.T_live_ref))) {
      ++tally.successes;
    }
    progress.advance();
  }
  return tally;
}

void validate(const Request& request) {
  if (request.output.empty()) throw mivo::UsageError("--output FILE.csv is missing");
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
  mivo::CommandLine line("convergence_experiment",
                         "Aligns pairs of frames of a synthetic sequence from random starts, and "
                         "counts how often the error ends below 0.01 m and 0.01 rad.");
  line.argument("FOLDER", &request.pairs.reference_folder, "sequence with groundtruth.txt");
  line.options()("output", po::value(&request.output)->value_name("FILE.csv"),
                 "one row per magnitude (required)")(
      "magnitude", po::value(&request.magnitudes)->composing()->value_name("N"),
      "norm of the six-vector (m, rad) by which starts are displaced; may be given several times")(
      "trials", po::value(&request.trials)->default_value(request.trials)->value_name("N"),
      "random starts per magnitude")(
      "pairs", po::value(&request.pairs.count)->default_value(request.pairs.count)->value_name("N"),
      "pairs of frames, among which the trials are shared out")(
      "gap", po::value(&request.pairs.gap)->default_value(request.pairs.gap)->value_name("N"),
      "frames from keyframe to live frame")(
      "live", po::value(&request.pairs.live_folder)->value_name("FOLDER"),
      "take the live frames from here: the same sequence in other light")(
      "seed", po::value(&request.seed)->default_value(request.seed)->value_name("N"),
      "other twists")("force", po::bool_switch(&request.force), "replace an existing file");
  parameter_options.declare(line);
  if (!line.parse(argc, argv)) return;
  validate(request);
  if (request.pairs.live_folder.empty()) {
    request.pairs.live_folder = request.pairs.reference_folder;
  }

  const mivo::Parameters parameters = parameter_options.parameters();
  const mivo::ImagePairs images = mivo::loadPairs(request.pairs, parameters);
  mivo::OutputFile file(request.output,
                        request.force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo);
  file.write("magnitude,trials,successes,iterations_mean,milliseconds_mean\n");
  const auto trials = static_cast<double>(request.trials);
  mivo::ProgressBar progress(request.magnitudes.size() * static_cast<std::size_t>(request.trials));
  for (std::size_t series = 0; series < request.magnitudes.size(); ++series) {
    const Tally tally = runTrials(images, parameters, request, series, progress);
    file.write(fmt::format(
        "{:.6g},{},{},{:.3f},{:.4f}\n", request.magnitudes[series], request.trials, tally.successes,
        static_cast<double>(tally.iterations) / trials, tally.milliseconds / trials));
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("convergence_experiment", [&] { run(argc, argv); });
}
