// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_run.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "core/execution/cpu_clock.h"
#include "evaluation/statistics.h"
#include "mivo/core/error.h"
#include "mivo/core/odometry.h"
#include "mivo/io/trajectory_io.h"
#include "programs/progress_bar.h"
#include "programs/statistics_file.h"

namespace mivo {
namespace {

constexpr std::size_t kToldFaults = 10;  // skipped frames told one by one; the rest only count

void count(const TrackingResult& result, const Frame& frame, TrackingSummary& summary) {
  ++summary.frames;
  switch (result.state) {
    case TrackingState::kInitialising:
      ++summary.initialising;
      summary.initialising_reason = describeReason(result);
      summary.initialising_depth = sampleDepth(frame);
      break;
    case TrackingState::kTracking:
      ++summary.tracked;
      break;
    case TrackingState::kDegraded:
      ++summary.degraded;
      break;
    case TrackingState::kLost:
      ++summary.lost;
      break;
  }
  summary.keyframes = result.keyframes;
  summary.segments = result.segment + 1;
  summary.rolling_shutter_readout = result.rolling_shutter_readout;
  summary.depth_time_offset = result.depth_time_offset;
}

const TrackingResult& process(Odometry& odometry, const Frame& frame,
                              std::optional<Disturbance>& disturbance) {
  // The first frame defines the world: there is nothing to start from, and nothing to disturb.
  if (!disturbance || !odometry.hasKeyframe()) return odometry.process(frame);
  return odometry.process(frame, odometry.predictedPose(frame.stamp) * disturbance->next());
}

void refuse(const TrackingResult& result, TrackingSummary& summary) {
  const std::string reason = describeReason(result);
  if (++summary.refused_frames[reason] > 1) return;
  std::cerr << fmt::format("refused: frame at {:.6f} s: {}; others like it are counted\n",
                           result.stamp, reason);
}

/// Whether the trajectory gets the pose.
bool isWanted(const TrackingResult& result, const TrackingOptions& options) {
  return result.isMeasured() || (result.state == TrackingState::kLost && options.write_lost);
}

}  // namespace

std::size_t TrackingSummary::numRefused() const {
  std::size_t sum = 0;
  for (const auto& [reason, number] : refused_frames) sum += number;
  return sum;
}

TrackingSummary trackFrames(FrameSource& source, const TrackingOptions& options) {
  // OpenCV warns of more threads than there are processors; the result is the same.
  cv::setNumThreads(std::min(options.parameters.alignment.threads, cv::getNumberOfCPUs()));
  const Overwrite overwrite = options.force ? Overwrite::kYes : Overwrite::kNo;
  Odometry odometry(source.camera(), options.parameters);
  if (!options.statistics.empty()) refuseExisting(options.statistics, overwrite);
  TrajectoryWriter trajectory(options.output, overwrite);
  std::unique_ptr<StatisticsFile> statistics;
  if (!options.statistics.empty()) {
    statistics = std::make_unique<StatisticsFile>(options.statistics, overwrite,
                                                  options.parameters.alignment.levels);
  }
  std::optional<Disturbance> disturbance = options.disturbance;
  ProgressBar progress(source.size());
  TrackingSummary summary;
  std::vector<double> cpu_times;
  Frame frame;
  std::string fault;
  for (auto status = source.next(frame, fault); status != FrameSource::Status::kEnd;
       status = source.next(frame, fault)) {
    if (status == FrameSource::Status::kSkipped) {
      progress.clear();
      if (++summary.skipped_frames <= kToldFaults) std::cerr << "skipped: " << fault << "\n";
      progress.advance();
      continue;
    }
    const double start = processMilliseconds();
    const TrackingResult& result = process(odometry, frame, disturbance);
    const double cpu_ms = processMilliseconds() - start;
    if (result.isRefused()) {
      progress.clear();
      refuse(result, summary);
      progress.advance();
      continue;
    }
    cpu_times.push_back(cpu_ms);
    if (isWanted(result, options)) trajectory.write({frame.stamp, result.T_odom_camera});
    if (statistics) statistics->write(frame.stamp, result, cpu_ms);
    count(result, frame, summary);
    progress.advance();
  }
  if (summary.frames + summary.numRefused() == 0) {
    throw Error("there was no frame to track" + (fault.empty() ? fault : ": " + fault));
  }
  if (cpu_times.empty()) return summary;
  summary.cpu_ms_median = quantile(cpu_times, 0.5);
  summary.cpu_ms_p95 = quantile(cpu_times, 0.95);
  return summary;
}

void print(std::ostream& stream, const TrackingSummary& summary) {
  stream << "frames: " << summary.frames << "\n"
         << "initialising: " << summary.initialising << "\n"
         << "tracked: " << summary.tracked << "\n"
         << "degraded: " << summary.degraded << "\n"
         << "lost: " << summary.lost << "\n"
         << "skipped_frames: " << summary.skipped_frames << "\n"
         << "refused_frames: " << summary.numRefused() << "\n"
         << "keyframes: " << summary.keyframes << "\n"
         << "segments: " << summary.segments << "\n"
         << "rolling_shutter_readout_s: " << summary.rolling_shutter_readout << "\n"
         << "depth_time_offset_s: " << summary.depth_time_offset << "\n"
         << "cpu_ms_median: " << summary.cpu_ms_median << "\n"
         << "cpu_ms_p95: " << summary.cpu_ms_p95 << "\n";
}

void requireTracked(const TrackingSummary& summary) {
  const std::size_t refused = summary.numRefused();
  const std::size_t measured = summary.tracked + summary.degraded;
  const bool is_alone = measured == 1 && summary.frames == 1 && refused > 0;
  if ((measured > 0 && !is_alone) || summary.lost > 0) return;
  std::string text = "nothing was tracked";
  if (summary.initialising > 0) {
    const DepthSample& depth = summary.initialising_depth;
    text += fmt::format("; {} frames: {}, ", summary.initialising, summary.initialising_reason);
    text += depth.median > 0.0
                ? fmt::format(
                      "{:.0f} % of the pixels have depth, its median is {:.4g} m (is the "
                      "unit of depth right?)",
                      100.0 * depth.coverage, depth.median)
                : std::string("no pixel has depth");
  }
  for (const auto& [reason, number] : summary.refused_frames) {
    text += fmt::format("; {} frames refused: {}", number, reason);
  }
  throw Error(text);
}

}  // namespace mivo
