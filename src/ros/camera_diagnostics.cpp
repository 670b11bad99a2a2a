// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <utility>

namespace mivo {
namespace {

constexpr double kPeriod = 1.0;  // s
constexpr double kPartsPerMillion = 1e6;
constexpr double kMillisecondsPerSecond = 1e3;
constexpr double kPercent = 100.0;

using Level = diagnostic_msgs::DiagnosticStatus;

unsigned char levelOf(const CameraStatus& status) {
  switch (status.state) {
    case CameraState::kWaiting:
      return Level::ERROR;
    case CameraState::kConnecting:
    case CameraState::kEnded:
      return Level::WARN;
    default:
      return status.slow ? Level::WARN : Level::OK;
  }
}

}  // namespace

CameraDiagnostics::CameraDiagnostics(const ros::NodeHandle& node,
                                     const ros::NodeHandle& private_node, const std::string& name,
                                     std::function<CameraReport()> report)
    : report_(std::move(report)),
      updater_(node, private_node, name),
      last_time_(ros::WallTime::now()) {
  updater_.setHardwareID("none");
  updater_.add("camera", this, &CameraDiagnostics::fill);
  timer_ = node.createWallTimer(ros::WallDuration(kPeriod),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void CameraDiagnostics::fill(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const CameraReport report = report_();
  const CameraStatus& camera = report.status;
  if (!camera.device.uri.empty()) {
    updater_.setHardwareID(camera.device.serial.empty() ? camera.device.uri : camera.device.serial);
  }
  std::string summary = toString(camera.state);
  if (camera.state == CameraState::kWaiting || camera.slow) {
    summary += ": " + camera.message;
  }
  status.summary(levelOf(camera), summary);
  status.add("state", toString(camera.state));
  status.add("fault", camera.fault ? toString(*camera.fault) : "none");
  status.add("message", camera.message);
  status.add("unused because", camera.listener_fault.empty() ? "none" : camera.listener_fault);
  status.add("device", camera.device.name);
  status.add("uri", camera.device.uri);
  status.add("serial", camera.device.serial);
  status.add("failed attempts", camera.failures);
  status.add("reconnections", camera.reconnections);
  status.add("rate asked for (Hz)", report.rate);
  for (StreamKind kind : {StreamKind::kColor, StreamKind::kDepth}) {
    const StreamStatistics& stream = camera.streams[static_cast<std::size_t>(kind)];
    const std::string name = toString(kind);
    status.add(name + " rate (Hz)", stream.rate);
    status.add(name + " images", stream.frames);
    status.add(name + " dropped", stream.dropped);
  }
  status.add("pairs", report.pairs.pairs);
  status.add("images without partner", report.pairs.singles);
  status.add("pairing offset (ms)", report.pairs.offset * kMillisecondsPerSecond);
  status.add("device clock (ppm)", camera.clock_skew * kPartsPerMillion);
  status.add("settings", toString(camera.settings));
  const ros::WallTime now = ros::WallTime::now();
  const double elapsed = (now - last_time_).toSec();
  status.add(
      "processor of the camera thread (%)",
      elapsed > 0.0 ? kPercent * (report.processor_time - last_processor_time_) / elapsed : 0.0);
  last_time_ = now;
  last_processor_time_ = report.processor_time;
}

}  // namespace mivo
