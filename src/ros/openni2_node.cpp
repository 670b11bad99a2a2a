// SPDX-License-Identifier: BSD-3-Clause
#include "ros/openni2_node.h"

#include <ros/console.h>

#include "openni2/openni2_device.h"
#include "ros/camera_frames.h"
#include "ros/guarded_call.h"

namespace mivo {
namespace {

constexpr double kSettingsPeriod = 0.2;  // s

std::int64_t hostTime() {
  return static_cast<std::int64_t>(ros::Time::now().toNSec());
}

std::optional<int> unlessZero(int value) {
  return value == 0 ? std::nullopt : std::optional<int>(value);
}

CameraSettings settingsOf(const OpenNI2Config& config) {
  CameraSettings settings;
  settings.auto_exposure = config.auto_exposure;
  settings.auto_white_balance = config.auto_white_balance;
  settings.exposure = unlessZero(config.exposure);
  settings.gain = unlessZero(config.gain);
  return settings;
}

}  // namespace

OpenNi2Node::OpenNi2Node(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                         const std::string& name)
    : name_(name),
      parameters_(readCameraParameters(private_node)),
      publisher_(private_node, parameters_,
                 [this](const StreamDemand& demand) { setDemand(demand); }),
      server_(server_mutex_, private_node) {
  if (parameters_.publish_tf) {
    broadcaster_.sendTransform(cameraTransforms(parameters_));
  }
  thread_ =
      std::make_unique<CameraThread>(parameters_.device, parameters_.times, OpenNi2Device::open,
                                     hostTime, static_cast<CameraListener&>(*this));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    running_thread_ = thread_.get();
    running_thread_->setDemand(demand_);  // of those who subscribed before there was a thread
  }
  server_.setCallback(
      [this](OpenNI2Config& config, std::uint32_t /*level*/) { reconfigure(config); });
  settings_timer_ = private_node.createWallTimer(
      ros::WallDuration(kSettingsPeriod), [this](const ros::WallTimerEvent&) {
        guardedCall("settings", [this] { publishTrueSettings(); });
      });
  diagnostics_ =
      std::make_unique<CameraDiagnostics>(node, private_node, name_, [this] { return report(); });
}

OpenNi2Node::~OpenNi2Node() {
  diagnostics_.reset();
  settings_timer_.stop();
  const std::lock_guard<std::mutex> lock(mutex_);
  running_thread_ = nullptr;
}

void OpenNi2Node::setDemand(const StreamDemand& demand) {
  const std::lock_guard<std::mutex> lock(mutex_);
  demand_ = demand;
  if (running_thread_ != nullptr) {
    running_thread_->setDemand(demand);
  }
}

void OpenNi2Node::reconfigure(const OpenNI2Config& config) {
  config_ = config;
  publisher_.setTimeOffsets(config.rgb_time_offset, config.depth_time_offset);
  thread_->setSettings(settingsOf(config));
}

void OpenNi2Node::publishTrueSettings() {
  std::optional<CameraSettings> settings;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    settings.swap(true_settings_);
  }
  if (!settings) {
    return;
  }
  config_.auto_exposure = settings->auto_exposure.value_or(config_.auto_exposure);
  config_.auto_white_balance = settings->auto_white_balance.value_or(config_.auto_white_balance);
  config_.exposure = settings->exposure.value_or(config_.exposure);
  config_.gain = settings->gain.value_or(config_.gain);
  server_.updateConfig(config_);
}

CameraReport OpenNi2Node::report() const {
  return {thread_->status(), publisher_.statistics(), thread_->processorTime(),
          parameters_.device.rate};
}

void OpenNi2Node::onImage(const ImageView& image, std::int64_t stamp) {
  publisher_.add(image, stamp);
}

void OpenNi2Node::onMessage(Severity severity, const std::string& line) {
  switch (severity) {
    case Severity::kInfo:
      ROS_INFO_STREAM(name_ << ": " << line);
      break;
    case Severity::kWarning:
      ROS_WARN_STREAM(name_ << ": " << line);
      break;
    case Severity::kError:
      ROS_ERROR_STREAM(name_ << ": " << line);
      break;
  }
}

void OpenNi2Node::onDevice(const DeviceDescription& device) {
  publisher_.setDevice(device);
}

void OpenNi2Node::onSettings(const CameraSettings& settings) {
  const std::lock_guard<std::mutex> lock(mutex_);
  true_settings_ = settings;
}

}  // namespace mivo
