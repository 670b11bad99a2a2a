// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_run.h"

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

void count(const TrackingResult& result, TrackingSummary& summary) {
  ++summary.frames;
  switch (result.state) {
    case TrackingState::kInitialising:
      ++summary.initialising;
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

}  // namespace

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
    cpu_times.push_back(processMilliseconds() - start);
    trajectory.write({frame.stamp, result.T_odom_camera});
    if (statistics) statistics->write(frame.stamp, result, cpu_times.back());
    count(result, summary);
    progress.advance();
  }
  if (summary.frames == 0) {
    throw Error("there was no frame to track" + (fault.empty() ? fault : ": " + fault));
  }
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
         << "keyframes: " << summary.keyframes << "\n"
         << "segments: " << summary.segments << "\n"
         << "rolling_shutter_readout_s: " << summary.rolling_shutter_readout << "\n"
         << "depth_time_offset_s: " << summary.depth_time_offset << "\n"
         << "cpu_ms_median: " << summary.cpu_ms_median << "\n"
         << "cpu_ms_p95: " << summary.cpu_ms_p95 << "\n";
}

}  // namespace mivo
