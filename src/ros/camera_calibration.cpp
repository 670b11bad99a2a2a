// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_calibration.h"

#include <ros/console.h>
#include <sensor_msgs/distortion_models.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

namespace mivo {
namespace {

// Of an Xtion's color camera, as its driver reports it; rad.
constexpr double kUsualFieldOfView = 1.0144686;

// camera_info_manager accepts only letters, digits and underscores.
std::string asName(const std::string& text) {
  std::string name = text;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

}  // namespace

sensor_msgs::CameraInfo cameraInfoFromFieldOfView(int width, int height, double field_of_view) {
  const double angle = field_of_view > 0.0 ? field_of_view : kUsualFieldOfView;
  const double f = 0.5 * width / std::tan(0.5 * angle);
  const double cx = 0.5 * (width - 1);
  const double cy = 0.5 * (height - 1);
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(width);
  info.height = static_cast<std::uint32_t>(height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(5, 0.0);
  info.K = {f, 0.0, cx, 0.0, f, cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {f, 0.0, cx, 0.0, 0.0, f, cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

CameraCalibration::CameraCalibration(const ros::NodeHandle& node, const std::string& name,
                                     const std::string& url)
    : name_(name), url_(url), manager_(node, name, url) {
  if (!url.empty() && !manager_.validateURL(url)) {
    ROS_ERROR_STREAM("The calibration URL '" << url
                                             << "' cannot be used; write file:///path/file.yaml or "
                                                "package://name/file.yaml. Continuing without it");
  }
}

void CameraCalibration::setDevice(const std::string& serial, double field_of_view) {
  const std::lock_guard<std::mutex> lock(mutex_);
  field_of_view_ = field_of_view;
  has_warned_of_size_ = false;
  manager_.setCameraName(serial.empty() ? name_ : name_ + "_" + asName(serial));
  if (url_.empty()) {
    manager_.loadCameraInfo("");  // the default file depends on the name
  }
}

sensor_msgs::CameraInfo CameraCalibration::info(int width, int height) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (manager_.isCalibrated()) {
    const sensor_msgs::CameraInfo info = manager_.getCameraInfo();
    if (info.width == static_cast<std::uint32_t>(width) &&
        info.height == static_cast<std::uint32_t>(height)) {
      return info;
    }
    if (!has_warned_of_size_) {
      has_warned_of_size_ = true;
      ROS_WARN_STREAM("The calibration of " << name_ << " is for " << info.width << "x"
                                            << info.height << ", the images are " << width << "x"
                                            << height
                                            << ": using the field of view of the device instead; "
                                               "calibrate at this size");
    }
  }
  return cameraInfoFromFieldOfView(width, height, field_of_view_);
}

}  // namespace mivo
