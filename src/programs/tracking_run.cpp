// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_run.h"

#include <fmt/format.h>

#include <iostream>
#include <opencv2/core/utility.hpp>

#include "core/execution/cpu_clock.h"
#include "mivo/core/odometry.h"
#include "mivo/io/trajectory_io.h"
#include "programs/progress_bar.h"
#include "programs/statistics_file.h"
#include "session/repeated_image.h"

namespace mivo {
namespace {

constexpr std::size_t kToldReasons = 10;  // to skip a frame; further ones are only counted

const TrackingResult& process(Odometry& odometry, const Frame& frame,
                              std::optional<Disturbance>& disturbance) {
  // The first frame defines the world: there is nothing to start from, and nothing to disturb.
  if (!disturbance || !odometry.hasKeyframe()) return odometry.process(frame);
  return odometry.process(frame, odometry.predictedPose(frame.stamp) * disturbance->next());
}

/// What was wrong with a frame that the odometry refused.
FrameFault refusalOf(const Frame& frame, const TrackingResult& result, const Camera& camera) {
  const std::string reason = result.reason == TrackingReason::kInvalidFrame
                                 ? findFault(frame, camera)
                                 : describeReason(result);
  return {fmt::format("frame of stamp {:.6f}: {}", frame.stamp, reason), reason};
}

bool isWritten(const TrackingResult& result, const TrackingOptions& options) {
  return result.isMeasured() || (options.write_lost && result.state == TrackingState::kLost);
}

/// Everything that a frame of the run goes to.
class TrackingRun {
 public:
  TrackingRun(const FrameSource& source, const TrackingOptions& options);

  void track(const Frame& frame);
  void skip(const FrameFault& fault);
  const TrackingSummary& summary() const { return summary_; }

 private:
  const TrackingOptions& options_;
  Odometry odometry_;
  std::optional<TrajectoryWriter> trajectory_;
  std::optional<StatisticsFile> statistics_;
  std::optional<Disturbance> disturbance_;
  RepeatedImage repeated_;
  ProgressBar progress_;
  TrackingSummary summary_;
};

TrackingRun::TrackingRun(const FrameSource& source, const TrackingOptions& options)
    : options_(options),
      odometry_(source.camera(), options.parameters),
      disturbance_(options.disturbance),
      progress_(source.size()) {
  const Overwrite overwrite = options.force ? Overwrite::kYes : Overwrite::kNo;
  requireOutputs({{"--output", options.output}, {"--statistics", options.statistics}},
                 options.inputs, overwrite);
  trajectory_.emplace(options.output, overwrite);
  if (options.statistics.empty()) return;
  statistics_.emplace(options.statistics, overwrite, options.parameters.alignment.levels);
}

void TrackingRun::track(const Frame& frame) {
  if (repeated_.check(frame)) {
    skip({fmt::format("frame of stamp {:.6f}: {}", frame.stamp, RepeatedImage::kReason),
          RepeatedImage::kReason});
    return;
  }
  const double start = processMilliseconds();
  const TrackingResult& result = process(odometry_, frame, disturbance_);
  const double cpu_ms = processMilliseconds() - start;
  if (result.isRefused()) {
    skip(refusalOf(frame, result, odometry_.camera()));
    return;
  }
  if (isWritten(result, options_)) trajectory_->write({frame.stamp, result.T_odom_camera});
  if (statistics_) statistics_->write(frame.stamp, result, cpu_ms);
  summary_.add(frame, result, cpu_ms);
  progress_.advance();
}

void TrackingRun::skip(const FrameFault& fault) {
  if (summary_.addSkipped(fault.reason) && summary_.skipped.size() <= kToldReasons) {
    progress_.clear();
    std::cerr << "skipped: " << fault.text << "\n";
  }
  progress_.advance();
}

}  // namespace

TrackingSummary trackFrames(FrameSource& source, const TrackingOptions& options) {
  // OpenCV warns of more threads than there are processors; the result is the same.
  cv::setNumThreads(std::min(options.parameters.alignment.threads, cv::getNumberOfCPUs()));
  TrackingRun run(source, options);
  Frame frame;
  FrameFault fault;
  for (auto status = source.next(frame, fault); status != FrameSource::Status::kEnd;
       status = source.next(frame, fault)) {
    if (status == FrameSource::Status::kFrame) {
      run.track(frame);
    } else {
      run.skip(fault);
    }
  }
  return run.summary();
}

void runTracking(const std::string& program, FrameSource& source, const TrackingOptions& options) {
  if (!source.notice().empty()) std::cerr << program << ": note: " << source.notice() << "\n";
  const TrackingSummary summary = trackFrames(source, options);
  print(std::cout, summary);
  const DepthParameters& depth = options.parameters.depth;
  requireTracked(summary, depth, source.depthUnit());
  const std::string fault = findDepthFault(summary, depth, source.depthUnit());
  if (!fault.empty()) std::cerr << program << ": note: " << fault << "\n";
}

}  // namespace mivo
