// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <iterator>
#include <opencv2/core/utility.hpp>
#include <string>

#include "fault_run.h"
#include "mivo/core/error.h"
#include "mivo/io/sequence_reader.h"
#include "mivo/io/trajectory_io.h"
#include "programs/command_line.h"

namespace {

namespace po = boost::program_options;

constexpr double kSameTime = 1e-4;  // s, of a frame and its true pose
// Part of the frames that are hit, from run to run: now and then, often, all.
constexpr double kRates[] = {0.1, 0.5, 1.0};

struct Options {
  std::string folder;
  std::string fault;
  int runs = 0;
  bool list = false;
};

mivo::TrueRecording load(const std::string& folder) {
  mivo::SequenceReader sequence(folder);
  const mivo::Trajectory truth = mivo::readTrajectory(folder + "/groundtruth.txt");
  mivo::TrueRecording recording;
  mivo::Frame frame;
  mivo::FrameFault fault;
  for (auto status = sequence.next(frame, fault); status != mivo::FrameSource::Status::kEnd;
       status = sequence.next(frame, fault)) {
    if (status != mivo::FrameSource::Status::kFrame) throw mivo::Error(fault.text);
    const auto pose =
        std::min_element(truth.begin(), truth.end(), [&](const auto& a, const auto& b) {
          return std::abs(a.stamp - frame.stamp) < std::abs(b.stamp - frame.stamp);
        });
    if (std::abs(pose->stamp - frame.stamp) > kSameTime) {
      throw mivo::Error(fmt::format("there is no true pose of stamp {:.6f}", frame.stamp));
    }
    recording.deliveries.push_back({frame, sequence.camera(), recording.deliveries.size()});
    recording.T_world_camera.push_back(pose->pose);
  }
  return recording;
}

/// One line: the worst of all runs, and in how many there was something wrong.
void experiment(const mivo::TrueRecording& recording, const Options& options) {
  double longest = 0.0;
  int recovery = 0;
  int wrong = 0;
  int overconfident = 0;
  for (int seed = 0; seed < options.runs; ++seed) {
    const double rate = kRates[static_cast<std::size_t>(seed) % std::size(kRates)];
    const mivo::FaultOutcome outcome =
        mivo::track(recording, {options.fault, rate, static_cast<std::uint32_t>(seed)}, {});
    longest = std::max(longest, outcome.longest);
    recovery = std::max(recovery, outcome.recovery);
    wrong += outcome.wrong > 0 ? 1 : 0;
    overconfident += outcome.overconfident > 0 ? 1 : 0;
  }
  fmt::print("runs: {}\nlongest_s: {:.3f}\nwrong: {}\noverconfident: {}\nrecovery: {}\n",
             options.runs, longest, wrong, overconfident, recovery);
}

void run(int argc, char** argv) {
  Options options;
  mivo::CommandLine line(
      "fault_experiment",
      "Tracks a sequence with true poses again and again while a fault spoils the "
      "second third of its frames, and tells the worst that came of it.");
  line.argument("FOLDER", &options.folder, "a sequence of generate_sequence");
  line.options()("fault", po::value(&options.fault)->value_name("NAME"), "one of --list")(
      "runs", po::value(&options.runs)->value_name("N")->default_value(100),
      "runs, each with a seed of its own")("list", po::bool_switch(&options.list),
                                           "print the names of the faults");
  if (!line.parse(argc, argv)) return;
  if (options.list) {
    for (const std::string& name : mivo::FrameFaults::names()) std::cout << name << "\n";
    return;
  }
  if (options.runs < 1) throw mivo::UsageError("--runs must be 1 at least");
  cv::setNumThreads(1);
  experiment(load(options.folder), options);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("fault_experiment", [&] { run(argc, argv); });
}
