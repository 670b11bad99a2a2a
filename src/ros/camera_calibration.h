// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <camera_info_manager/camera_info_manager.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>

#include <mutex>
#include <string>

namespace mivo {

/// Intrinsics of one of the cameras: a calibration file where there is one that fits the images,
/// otherwise a pinhole camera made from the field of view that the device tells.
class CameraCalibration {
 public:
  /// Offers the service NODE/set_camera_info. An empty url means the file of this camera in
  /// ~/.ros/camera_info.
  CameraCalibration(const ros::NodeHandle& node, const std::string& name, const std::string& url);

  /// A device was opened: the file of this very camera is looked for, by its serial number.
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

/// Square pixels, principal point in the middle of the image (pixel centres at integers). An
/// unknown field of view is taken to be that of an Xtion.
sensor_msgs::CameraInfo cameraInfoFromFieldOfView(int width, int height, double field_of_view);

}  // namespace mivo
