// SPDX-License-Identifier: BSD-3-Clause
#include "pair_experiment.h"

#include <cmath>
#include <cstdint>

#include "mivo/core/se3.h"
#include "random_twist.h"

namespace mivo {

namespace po = boost::program_options;

void PairExperiment::declare(CommandLine& line, const std::string& rows) {
  line.argument("FOLDER", &pairs_.reference_folder, "sequence with groundtruth.txt");
  line.options()("output", po::value(&output_)->value_name("FILE.csv"),
                 (rows + " (required)").c_str())(
      "magnitude", po::value(&magnitudes_)->composing()->value_name("N"),
      "norm of the six-vector (m, rad) by which starts are displaced; may be given several times")(
      "trials", po::value(&trials_)->default_value(trials_)->value_name("N"),
      "random starts per magnitude")(
      "pairs", po::value(&pairs_.count)->default_value(pairs_.count)->value_name("N"),
      "pairs of frames, among which the trials are shared out")(
      "gap", po::value(&pairs_.gap)->default_value(pairs_.gap)->value_name("N"),
      "frames from keyframe to live frame")(
      "seed", po::value(&seed_)->default_value(seed_)->value_name("N"), "other twists")(
      "force", po::bool_switch(&force_), "replace an existing file");
  parameter_options_.declare(line);
}

void PairExperiment::declareLive(CommandLine& line) {
  line.options()("live", po::value(&pairs_.live_folder)->value_name("FOLDER"),
                 "take the live frames from here: the same sequence in other light");
}

void PairExperiment::validate() {
  if (output_.empty()) throw UsageError("--output FILE.csv is missing");
  if (magnitudes_.empty()) throw UsageError("--magnitude N is missing");
  for (const double magnitude : magnitudes_) {
    if (!std::isfinite(magnitude) || magnitude < 0.0) {
      throw UsageError("--magnitude must not be negative");
    }
  }
  if (trials_ < 1) throw UsageError("--trials must be 1 at least");
  if (seed_ < 0) throw UsageError("--seed must not be negative");
  if (pairs_.live_folder.empty()) pairs_.live_folder = pairs_.reference_folder;
}

ImagePairs PairExperiment::loadPairs(const Parameters& parameters) const {
  return mivo::loadPairs(pairs_, parameters);
}

OutputFile PairExperiment::openOutput() const {
  return OutputFile(output_, force_ ? Overwrite::kYes : Overwrite::kNo);
}

void PairExperiment::run(const ImagePairs& images, std::size_t series, ProgressBar& progress,
                         const Visit& visit) const {
  for (std::size_t trial = 0; trial < trials(); ++trial) {
    const ImagePair& pair = images.pairs[trial % images.pairs.size()];
    const Vector6 twist =
        randomTwist(magnitudes_[series], static_cast<std::uint64_t>(seed_), series, trial);
    visit(pair, pair.T_live_ref * expSe3(twist));
    progress.advance();
  }
}

}  // namespace mivo
