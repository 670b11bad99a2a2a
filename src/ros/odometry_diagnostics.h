// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <mivo/TrackingStatus.h>

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

#include "ros/frame_input.h"
#include "ros/skipped_frames.h"
#include "session/depth_sample.h"

namespace mivo {

/// Entries on /diagnostics: tracking, input, processing. Thread-safe.
class OdometryDiagnostics {
 public:
  OdometryDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                      const std::string& name);

  /// A fault that prevents the node from working, such as an invalid parameter.
  void setFault(const std::string& fault);
  void setPaused(bool paused);

  void addFrame(const TrackingStatus& status, const DepthSample& depth);

  /// Publishes. `counts`: as FrameInput gives them, or empty.
  void publish(const std::vector<InputCount>& counts, const SkipCounts& skipped,
               std::uint64_t dropped);

 private:
  void tracking(diagnostic_updater::DiagnosticStatusWrapper& status);
  void input(diagnostic_updater::DiagnosticStatusWrapper& status);
  void processing(diagnostic_updater::DiagnosticStatusWrapper& status);

  struct Sample {  // of one frame
    ros::WallTime arrival;
    double cpu_ms;
    double latency;             // s, since the stamp
    double processing_latency;  // s, since the arrival of the images
    double pairing_offset;
  };

  std::mutex mutex_;
  std::string fault_;
  bool paused_ = false;
  TrackingStatus last_;
  DepthSample depth_;
  SkipCounts skipped_;
  std::uint64_t skipped_before_ = 0;  // at the last publication
  std::uint64_t dropped_ = 0;
  std::vector<InputCount> counts_;
  std::vector<InputCount> counts_before_;
  double seconds_ = 0.0;  // since the last publication
  ros::WallTime last_publication_;
  std::deque<Sample> samples_;  // of the last seconds
  diagnostic_updater::Updater updater_;
};

}  // namespace mivo
