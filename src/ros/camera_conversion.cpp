// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_conversion.h"

#include <sensor_msgs/distortion_models.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr std::size_t kPlumbBobSize = 5;

bool isZero(double value) {
  return value == 0.0;
}

/// Coefficients k1 k2 p1 p2 k3 of the message; fewer are filled up with zeros.
Distortion toDistortion(const sensor_msgs::CameraInfo& message) {
  const std::string remedy = "; rectify the images with image_proc and use its image_rect topic";
  const bool none = std::all_of(message.D.begin(), message.D.end(), isZero);
  const std::string& model = message.distortion_model;
  if (model.empty() && none) return {};
  if (model != sensor_msgs::distortion_models::PLUMB_BOB &&
      model != sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL) {
    throw Error("camera_info has the lens model '" + model + "', expected plumb_bob" + remedy);
  }
  if (message.D.size() > kPlumbBobSize &&
      !std::all_of(message.D.begin() + kPlumbBobSize, message.D.end(), isZero)) {
    throw Error("camera_info has a lens model with " + std::to_string(message.D.size()) +
                " coefficients, expected plumb_bob with 5" + remedy);
  }
  std::array<double, kPlumbBobSize> d{};
  std::copy_n(message.D.begin(), std::min(message.D.size(), kPlumbBobSize), d.begin());
  return {d[0], d[1], d[2], d[3], d[4]};
}

/// Pinhole values of a matrix with `columns` columns: K has 3, P has 4.
void setPinhole(Camera& camera, const double* matrix, int columns, const char* name) {
  camera.fx = matrix[0];
  camera.cx = matrix[2];
  camera.fy = matrix[columns + 1];
  camera.cy = matrix[columns + 2];
  if (!(camera.fx > 0.0 && camera.fy > 0.0)) {
    throw Error(std::string("camera_info is not calibrated: ") + name +
                " has no positive focal length; set the camera's calibration file");
  }
  if (matrix[1] != 0.0) {
    throw Error(std::string("camera_info: ") + name + " has skew, which is not supported");
  }
}

}  // namespace

bool isRectifiedTopic(const std::string& topic) {
  return topic.find("/image_rect") != std::string::npos || topic.rfind("image_rect", 0) == 0;
}

Camera toCamera(const sensor_msgs::CameraInfo& message, bool rectified) {
  if (message.binning_x > 1 || message.binning_y > 1) {
    throw Error(
        "camera_info has binning, which is not supported; use a calibration for the size of the "
        "image");
  }
  Camera camera;
  camera.width = static_cast<int>(message.width);
  camera.height = static_cast<int>(message.height);
  if (rectified) {
    setPinhole(camera, message.P.data(), 4, "P");
  } else {
    setPinhole(camera, message.K.data(), 3, "K");
    camera.distortion = toDistortion(message);
  }
  const sensor_msgs::RegionOfInterest& region = message.roi;
  if (region.width > 0 && region.height > 0) {
    camera.width = static_cast<int>(region.width);
    camera.height = static_cast<int>(region.height);
    camera.cx -= region.x_offset;
    camera.cy -= region.y_offset;
  }
  camera.validate();
  return camera;
}

sensor_msgs::CameraInfo toCameraInfo(const Camera& camera) {
  sensor_msgs::CameraInfo message;
  message.width = static_cast<std::uint32_t>(camera.width);
  message.height = static_cast<std::uint32_t>(camera.height);
  message.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  const Distortion& d = camera.distortion;
  message.D = {d.k1, d.k2, d.p1, d.p2, d.k3};
  message.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

}  // namespace mivo
