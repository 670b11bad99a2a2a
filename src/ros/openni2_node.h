// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <mivo/OpenNI2Config.h>
#include <ros/node_handle.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <boost/thread/recursive_mutex.hpp>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "openni2/camera_thread.h"
#include "ros/camera_diagnostics.h"
#include "ros/camera_parameters.h"
#include "ros/camera_publisher.h"

namespace mivo {

/// The camera node, ROS interface of a CameraThread. Only its destructor waits for USB.
class OpenNi2Node : private CameraListener {
 public:
  /// Throws Error for invalid parameters. A missing camera is not an error: the node waits for it.
  OpenNi2Node(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
              const std::string& name);
  ~OpenNi2Node() override;

 private:
  // In the camera's thread.
  void onImage(const ImageView& image, std::int64_t stamp) override;
  void onMessage(Severity severity, const std::string& line) override;
  void onDevice(const DeviceDescription& device) override;
  void onSettings(const CameraSettings& settings) override;

  // In the node's queue.
  void setDemand(const StreamDemand& demand);
  void reconfigure(const OpenNI2Config& config);
  void publishTrueSettings();
  CameraReport report() const;

  const std::string name_;
  const CameraParameters parameters_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;

  mutable std::mutex mutex_;  ///< guards the next three members, held briefly
  StreamDemand demand_;
  std::optional<CameraSettings> true_settings_;  ///< read back, not yet published
  CameraThread* running_thread_ = nullptr;

  CameraPublisher publisher_;
  std::unique_ptr<CameraThread> thread_;
  OpenNI2Config config_;
  boost::recursive_mutex server_mutex_;
  dynamic_reconfigure::Server<OpenNI2Config> server_;
  ros::WallTimer settings_timer_;
  std::unique_ptr<CameraDiagnostics> diagnostics_;
};

}  // namespace mivo
