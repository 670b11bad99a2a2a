// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <opencv2/core/utility.hpp>

#include "core/camera_doubt.h"
#include "core/execution/cpu_clock.h"
#include "io/numbered_path.h"
#include "mivo/core/odometry.h"
#include "mivo/io/trajectory_io.h"
#include "programs/progress_bar.h"
#include "programs/statistics_file.h"
#include "session/repeated_image.h"
#include "session/tracking_session.h"

namespace mivo {
namespace {

constexpr std::size_t kToldReasons = 10;  // to skip a frame; further ones are only counted

const TrackingResult& process(TrackingSession& session, const Frame& frame,
                              std::optional<Disturbance>& disturbance) {
  // The first frame defines the world: there is nothing to start from, and nothing to disturb.
  const Odometry& odometry = session.odometry();
  if (!disturbance || !odometry.hasKeyframe()) return session.process(frame, nullptr);
  const Eigen::Isometry3d start = odometry.predictedPose(frame.stamp) * disturbance->next();
  return session.process(frame, &start);
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

  /// @param starts_anew  time was set back before it
  void track(const Frame& frame, const Camera& camera, bool starts_anew);
  void skip(const FrameFault& fault);
  const TrackingSummary& summary() const { return summary_; }

 private:
  void restart(double stamp);
  void openTrajectory();
  void tell(const std::string& text);

  const TrackingOptions& options_;
  TrackingSession session_;
  int trajectories_ = 0;
  std::optional<TrajectoryWriter> trajectory_;
  std::optional<StatisticsFile> statistics_;
  std::optional<Disturbance> disturbance_;
  RepeatedImage repeated_;
  ProgressBar progress_;
  TrackingSummary summary_;
};

TrackingRun::TrackingRun(const FrameSource& source, const TrackingOptions& options)
    : options_(options),
      session_(options.parameters),
      disturbance_(options.disturbance),
      progress_(source.size()) {
  session_.setCamera(source.camera());
  const Overwrite overwrite = options.force ? Overwrite::kYes : Overwrite::kNo;
  requireOutputs({{"--output", options.output}, {"--statistics", options.statistics}},
                 options.inputs, overwrite);
  openTrajectory();
  if (options.statistics.empty()) return;
  statistics_.emplace(options.statistics, overwrite, options.parameters.alignment.levels);
}

void TrackingRun::openTrajectory() {
  trajectory_.emplace(numberedPath(options_.output, ++trajectories_),
                      options_.force ? Overwrite::kYes : Overwrite::kNo);
}

void TrackingRun::tell(const std::string& text) {
  progress_.clear();
  std::cerr << "note: " << text << "\n";
}

void TrackingRun::restart(double stamp) {
  session_.restart();
  openTrajectory();
  tell(
      fmt::format("frame of stamp {:.6f}: time was set back; tracking restarts at the last "
                  "pose, and the trajectory goes on in {}",
                  stamp, numberedPath(options_.output, trajectories_)));
}

void TrackingRun::track(const Frame& frame, const Camera& camera, bool starts_anew) {
  if (starts_anew) restart(frame.stamp);
  if (repeated_.check(frame)) {
    skip({fmt::format("frame of stamp {:.6f}: {}", frame.stamp, RepeatedImage::kReason),
          RepeatedImage::kReason});
    return;
  }
  if (session_.setCamera(camera)) {
    tell(
        fmt::format("frame of stamp {:.6f}: the calibration has changed; tracking restarts at "
                    "the last pose",
                    frame.stamp));
  }
  const double start = processMilliseconds();
  const TrackingResult& result = process(session_, frame, disturbance_);
  const double cpu_ms = processMilliseconds() - start;
  if (result.isRefused()) {
    skip(refusalOf(frame, result, camera));
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
      run.track(frame, source.camera(), source.startsAnew());
    } else {
      run.skip(fault);
    }
  }
  TrackingSummary summary = run.summary();
  summary.left_out = source.leftOut();
  return summary;
}

void runTracking(const std::string& program, FrameSource& source, const TrackingOptions& options) {
  for (const std::string& notice : {source.notice(), describeCoarseness(source.camera())}) {
    if (!notice.empty()) std::cerr << program << ": note: " << notice << "\n";
  }
  const TrackingSummary summary = trackFrames(source, options);
  print(std::cout, summary);
  const DepthParameters& depth = options.parameters.depth;
  requireTracked(summary, depth, source.depthUnit());
  const std::string fault =
      summary.depth.findFault(depth, source.depthUnit(), DepthAccount::Expected::kRoom);
  if (!fault.empty()) std::cerr << program << ": note: " << fault << "\n";
}

}  // namespace mivo
