// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstddef>

#include "core/alignment/align.h"
#include "core/execution/cpu_clock.h"
#include "pair_experiment.h"
#include "random_twist.h"

// How far from the truth a method may start (paper, IV-B2 and Fig. 3).

namespace {

struct Tally {
  long long successes = 0;
  long long iterations = 0;
  double milliseconds = 0.0;
};

void alignFrom(const Eigen::Isometry3d& start, const mivo::ImagePair& pair,
               const mivo::Camera& camera, const mivo::Parameters& parameters, Tally& tally) {
  const double begin = mivo::threadMilliseconds();
  mivo::AlignmentTask task{pair.keyframe, pair.live, camera};
  task.T_live_ref = task.motion.T_previous_ref = start;
  const mivo::Alignment alignment = mivo::align(task, parameters);
  tally.milliseconds += mivo::threadMilliseconds() - begin;
  for (int l = 0; l < alignment.num_levels; ++l) {
    tally.iterations += alignment.levels[static_cast<std::size_t>(l)].iterations;
  }
  // What is not finite is no success.
  if (mivo::isSuccess(mivo::difference(alignment.T_live_ref, pair.T_live_ref))) {
    ++tally.successes;
  }
}

void run(int argc, char** argv) {
  mivo::PairExperiment experiment(1000);
  mivo::CommandLine line("convergence_experiment",
                         "Aligns pairs of frames of a synthetic sequence from random starts, and "
                         "counts how often the error ends below 0.01 m and 0.01 rad.");
  experiment.declare(line, "one row per magnitude");
  experiment.declareLive(line);
  if (!line.parse(argc, argv)) return;
  experiment.validate();

  const mivo::Parameters parameters = experiment.parameters();
  const mivo::ImagePairs images = experiment.loadPairs(parameters);
  mivo::OutputFile file = experiment.openOutput();
  file.write("magnitude,trials,successes,iterations_mean,milliseconds_mean\n");
  const auto trials = static_cast<double>(experiment.trials());
  mivo::ProgressBar progress = experiment.progressBar();
  for (std::size_t series = 0; series < experiment.magnitudes().size(); ++series) {
    Tally tally;
    experiment.run(images, series, progress,
                   [&](const mivo::ImagePair& pair, const Eigen::Isometry3d& start) {
                     alignFrom(start, pair, images.camera, parameters, tally);
                   });
    file.write(fmt::format("{:.6g},{},{},{:.3f},{:.4f}\n", experiment.magnitudes()[series],
                           experiment.trials(), tally.successes,
                           static_cast<double>(tally.iterations) / trials,
                           tally.milliseconds / trials));
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("convergence_experiment", [&] { run(argc, argv); });
}
