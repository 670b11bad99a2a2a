// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <camera_info_manager/camera_info_manager.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>

#include <mutex>
#include <string>

namespace mivo {

/// Intrinsics of one of the cameras: from a calibration file that matches the images, or a pinhole
/// camera from the field of view that the device reports.
class CameraCalibration {
 public:
  /// Offers the service NODE/set_camera_info. An empty url means the file of this camera in
  /// ~/.ros/camera_info.
  CameraCalibration(const ros::NodeHandle& node, const std::string& name, const std::string& url);

  /// Called when a device was opened: loads the calibration file of its serial number.
  /// @param field_of_view horizontal, rad; 0: not known
  void setDevice(const std::string& serial, double field_of_view);

  /// For images of this size; header left empty.
  sensor_msgs::CameraInfo info(int width, int height);

 private:
  const std::string name_;
  const std::string url_;
  camera_info_manager::CameraInfoManager manager_;
  std::mutex mutex_;
  double field_of_view_ = 0.0;
  bool has_warned_of_size_ = false;
};

/// Square pixels, principal point in the middle of the image (pixel centers at integers). An
/// unknown field of view is assumed to be that of an Xtion.
sensor_msgs::CameraInfo cameraInfoFromFieldOfView(int width, int height, double field_of_view);

}  // namespace mivo
