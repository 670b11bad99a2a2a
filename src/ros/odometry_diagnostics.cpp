// SPDX-License-Identifier: BSD-3-Clause
#include "ros/odometry_diagnostics.h"

#include <algorithm>
#include <functional>

#include "evaluation/statistics.h"

namespace mivo {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;
using Wrapper = diagnostic_updater::DiagnosticStatusWrapper;

constexpr double kWindow = 5.0;       // s, over which rates and times are taken
constexpr double kPairedPart = 0.8;   // of the images of the slower topic that find a partner
constexpr double kMinCoverage = 0.1;  // of the pixels with depth

}  // namespace

OdometryDiagnostics::OdometryDiagnostics(const ros::NodeHandle& node,
                                         const ros::NodeHandle& private_node,
                                         const std::string& name)
    : last_publication_(ros::WallTime::now()), updater_(node, private_node, name) {
  updater_.setHardwareID("none");
  updater_.add("tracking", [this](Wrapper& status) { tracking(status); });
  updater_.add("input", [this](Wrapper& status) { input(status); });
  updater_.add("processing", [this](Wrapper& status) { processing(status); });
}

void OdometryDiagnostics::setFault(const std::string& fault) {
  const std::lock_guard<std::mutex> lock(mutex_);
  fault_ = fault;
}

void OdometryDiagnostics::setPaused(bool paused) {
  const std::lock_guard<std::mutex> lock(mutex_);
  paused_ = paused;
}

void OdometryDiagnostics::addFrame(const TrackingStatus& status, const DepthSample& depth) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_ = status;
  depth_ = depth;
  samples_.push_back({ros::WallTime::now(), status.conversion_cpu_ms + status.total_cpu_ms,
                      status.latency, status.processing_latency, status.pairing_offset});
}

void OdometryDiagnostics::publish(const std::vector<InputCount>& counts, const SkipCounts& skipped,
                                  std::uint64_t dropped) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::WallTime now = ros::WallTime::now();
    seconds_ = (now - last_publication_).toSec();
    last_publication_ = now;
    counts_before_ = counts_.empty() ? counts : counts_;
    counts_ = counts;
    skipped_before_ = skipped_.total;
    skipped_ = skipped;
    dropped_ = dropped;
    while (!samples_.empty() && (now - samples_.front().arrival).toSec() > kWindow) {
      samples_.pop_front();
    }
  }
  updater_.force_update();
}

void OdometryDiagnostics::tracking(Wrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.add("frames tracked", last_.frames);
  status.add("state", last_.state_text);
  status.add("reason", last_.reason_text);
  status.add("keyframes", last_.keyframes);
  status.add("segment", last_.segment);
  status.add("points", last_.points);
  status.addf("overlap", "%.2f", last_.overlap);
  status.addf("mutual information (nats)", "%.3f", last_.mutual_information);
  status.addf("residual scale (gray levels)", "%.2f", last_.residual_scale);
  status.addf("rolling shutter read-out (ms)", "%.1f", 1e3 * last_.rolling_shutter_readout);
  status.addf("time offset of depth (ms)", "%.1f", 1e3 * last_.depth_time_offset);
  if (!fault_.empty()) {
    status.summary(Level::ERROR, "idle: " + fault_);
  } else if (paused_) {
    status.summary(Level::WARN, "paused");
  } else if (samples_.empty()) {
    status.summary(Level::ERROR, "no frames");
  } else if (last_.state == TrackingStatus::TRACKING) {
    status.summary(Level::OK, "tracking");
  } else {
    const bool lost = last_.state == TrackingStatus::LOST;
    status.summary(lost ? Level::ERROR : Level::WARN, last_.state_text + ": " + last_.reason_text);
  }
}

void OdometryDiagnostics::input(Wrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  double slowest = -1.0;  // messages of the slower image topic
  for (std::size_t i = 0; i < counts_.size() && i < counts_before_.size(); ++i) {
    const auto messages = static_cast<double>(counts_[i].messages - counts_before_[i].messages);
    status.addf(counts_[i].topic + " (Hz)", "%.1f", seconds_ > 0.0 ? messages / seconds_ : 0.0);
    if (i >= 2) continue;  // the calibration
    status.add(counts_[i].topic + " without partner", counts_[i].without_partner);
    slowest = slowest < 0.0 ? messages : std::min(slowest, messages);
  }
  const auto pairs = static_cast<double>(
      std::count_if(samples_.begin(), samples_.end(), [this](const Sample& sample) {
        return (last_publication_ - sample.arrival).toSec() <= seconds_;
      }));
  std::vector<double> offsets;
  for (const Sample& sample : samples_) offsets.push_back(sample.pairing_offset);
  status.addf("pairs (Hz)", "%.1f", seconds_ > 0.0 ? pairs / seconds_ : 0.0);
  if (!offsets.empty()) {
    status.addf("depth later than color (ms, median)", "%.1f", 1e3 * quantile(offsets, 0.5));
  }
  status.addf("pixels with depth", "%.2f", depth_.coverage);
  status.addf("median depth (m)", "%.2f", depth_.median);
  status.add("dropped frames", dropped_);
  status.add("skipped frames", skipped_.total);
  for (const auto& [reason, number] : skipped_.by_reason) status.add("skipped: " + reason, number);
  if (skipped_.total > skipped_before_) {
    status.summary(Level::WARN, "frames skipped: " + skipped_.last_reason);
  } else if (samples_.empty()) {
    status.summary(Level::WARN, "no frames");
  } else if (slowest > 1.0 && pairs + 1.0 < kPairedPart * slowest) {
    status.summary(Level::WARN,
                   "many images have no partner: tracking is too slow, or color and depth have "
                   "different rates (auto exposure slows the color stream of some cameras)");
  } else if (depth_.coverage < kMinCoverage) {
    status.summary(Level::WARN, "few pixels have depth");
  } else {
    status.summary(Level::OK, "receiving frames");
  }
}

void OdometryDiagnostics::processing(Wrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<double> cpu;
  std::vector<double> latency;
  std::vector<double> processing;
  for (const Sample& sample : samples_) {
    cpu.push_back(sample.cpu_ms);
    latency.push_back(sample.latency);
    processing.push_back(sample.processing_latency);
  }
  if (cpu.empty()) {
    status.summary(Level::OK, "no frames");
    return;
  }
  status.addf("processor time of a frame (ms, median)", "%.1f", quantile(cpu, 0.5));
  status.addf("processor time of a frame (ms, 95 %)", "%.1f", quantile(cpu, 0.95));
  status.addf("from images to odometry (ms, median)", "%.1f", 1e3 * quantile(processing, 0.5));
  status.addf("from images to odometry (ms, 95 %)", "%.1f", 1e3 * quantile(processing, 0.95));
  status.addf("from stamp to odometry (ms, median)", "%.1f", 1e3 * quantile(latency, 0.5));
  status.addf("from stamp to odometry (ms, 95 %)", "%.1f", 1e3 * quantile(latency, 0.95));
  status.addf("conversion (ms)", "%.2f", last_.conversion_cpu_ms);
  status.addf("pyramid (ms)", "%.2f", last_.pyramid_cpu_ms);
  status.addf("tracking (ms)", "%.2f", last_.tracking_cpu_ms);
  status.addf("keyframe (ms)", "%.2f", last_.keyframe_cpu_ms);
  status.summaryf(Level::OK, "%.1f ms of processor time per frame", quantile(cpu, 0.5));
}

}  // namespace mivo
