// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "openni2/camera_session.h"
#include "ros/camera_publisher.h"

namespace mivo {

struct CameraReport {
  CameraStatus status;
  PairStatistics pairs;
  double processor_time = 0.0;  ///< s, used by the camera's thread so far
  int rate = 30;                ///< Hz, requested
};

/// State of the camera on /diagnostics once a second.
class CameraDiagnostics {
 public:
  /// @param report called in the node's queue; it must not block on the camera
  CameraDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const std::string& name, std::function<CameraReport()> report);

 private:
  void fill(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::function<CameraReport()> report_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
  ros::WallTime last_time_;
  double last_processor_time_ = 0.0;
};

}  // namespace mivo
