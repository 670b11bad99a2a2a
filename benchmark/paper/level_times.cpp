// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <string>

#include "mivo/core/error.h"
#include "mivo/core/odometry.h"
#include "mivo/io/sequence_reader.h"
#include "parameter_options.h"
#include "programs/command_line.h"

// Processor time per pyramid level, with and without the line search (paper, Table I).

namespace {

/// Mean and standard deviation of numbers that come one by one.
class Spread {
 public:
  void add(double value) {
    ++count_;
    const double change = value - mean_;
    mean_ += change / count_;
    squares_ += change * (value - mean_);
  }
  std::string text() const {
    const double variance = count_ > 1 ? squares_ / (count_ - 1) : 0.0;
    return fmt::format("{:.5f},{:.5f}", mean_, std::sqrt(variance));
  }

 private:
  double count_ = 0.0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

struct LevelTimes {
  Spread total;
  Spread line_search;
  Spread iterations;

  void add(double milliseconds, double line_search_milliseconds, double steps) {
    total.add(milliseconds);
    line_search.add(line_search_milliseconds);
    iterations.add(steps);
  }
  std::string text() const {
    return total.text() + "," + line_search.text() + "," + iterations.text();
  }
};

void run(int argc, char** argv) {
  std::string folder;
  mivo::ParameterOptions parameter_options;
  mivo::CommandLine line("level_times",
                         "Tracks a sequence on one thread and prints the processor time of each "
                         "pyramid level, mean and standard deviation over the frames.");
  line.argument("FOLDER", &folder, "sequence folder");
  parameter_options.declare(line);
  if (!line.parse(argc, argv)) return;

  const mivo::Parameters parameters = parameter_options.parameters();
  cv::setNumThreads(1);
  mivo::SequenceReader reader(folder);
  mivo::Odometry odometry(reader.camera(), parameters);
  std::array<LevelTimes, mivo::kMaxLevels> levels;
  LevelTimes all;
  int num_levels = 0;
  mivo::Frame frame;
  std::string fault;
  for (auto status = reader.next(frame, fault); status != mivo::FrameSource::Status::kEnd;
       status = reader.next(frame, fault)) {
    if (status == mivo::FrameSource::Status::kSkipped) continue;
    const mivo::TrackingResult& result = odometry.process(frame);
    if (result.num_levels == 0) continue;  // a first frame is not aligned
    num_levels = result.num_levels;
    mivo::LevelRecord sum;
    for (int i = 0; i < num_levels; ++i) {
      const mivo::LevelRecord& record = result.levels[static_cast<std::size_t>(i)];
      levels[static_cast<std::size_t>(record.level)].add(
          record.milliseconds, record.line_search_milliseconds, record.iterations);
      sum.milliseconds += record.milliseconds;
      sum.line_search_milliseconds += record.line_search_milliseconds;
      sum.iterations += record.iterations;
    }
    all.add(sum.milliseconds, sum.line_search_milliseconds, sum.iterations);
  }
  if (num_levels == 0) throw mivo::Error(folder + ": no frame was aligned with another");
  std::cout << "level,ms_mean,ms_deviation,line_search_ms_mean,line_search_ms_deviation,"
               "iterations_mean,iterations_deviation\n";
  for (int level = num_levels - 1; level >= 0; --level) {
    std::cout << level << "," << levels[static_cast<std::size_t>(level)].text() << "\n";
  }
  std::cout << "all," << all.text() << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("level_times", [&] { run(argc, argv); });
}
