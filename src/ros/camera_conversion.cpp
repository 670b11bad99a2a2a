// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_conversion.h"

#include <sensor_msgs/distortion_models.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr std::size_t kMaxCoefficients = 8;
// rad; an equidistant lens with a smaller field of view is none: drivers write the model's name
// and zeros for rectified images, as image_geometry takes them.
constexpr double kLeastFisheyeField = 1.4;

const char kEquidistantModel[] = "equidistant";  // sensor_msgs does not name it everywhere

bool isZero(double value) {
  return value == 0.0;
}

[[noreturn]] void refuseLens(const std::string& what) {
  throw Error("camera_info has " + what +
              ", expected plumb_bob, rational_polynomial or equidistant; rectify the images with "
              "image_proc and use its image_rect topic");
}

/// D in the order of the message; fewer coefficients are filled up with zeros.
Distortion toDistortion(const sensor_msgs::CameraInfo& message) {
  const bool none = std::all_of(message.D.begin(), message.D.end(), isZero);
  const std::string& model = message.distortion_model;
  const bool equidistant = model == kEquidistantModel;
  if (none && (!equidistant || message.width < kLeastFisheyeField * message.K[0])) return {};
  if (!equidistant && model != sensor_msgs::distortion_models::PLUMB_BOB &&
      model != sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL) {
    refuseLens("the lens model '" + model + "'");
  }
  const std::size_t most = equidistant ? 4 : kMaxCoefficients;
  if (message.D.size() > most && !std::all_of(message.D.begin() + static_cast<std::ptrdiff_t>(most),
                                              message.D.end(), isZero)) {
    refuseLens("a lens model '" + model + "' with " + std::to_string(message.D.size()) +
               " coefficients, of which those from number " + std::to_string(most + 1) +
               " on are not 0" + (equidistant ? "" : " (thin prism, tilt)"));
  }
  std::array<double, kMaxCoefficients> d{};
  std::copy_n(message.D.begin(), std::min(message.D.size(), most), d.begin());
  if (!equidistant) return {d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]};
  Distortion lens;
  lens.model = LensModel::kEquidistant;
  lens.k1 = d[0];
  lens.k2 = d[1];
  lens.k3 = d[2];
  lens.k4 = d[3];
  return lens;
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
  const double* last = matrix + 2 * columns;
  if (last[0] != 0.0 || last[1] != 0.0 || last[2] != 1.0) {
    throw Error(std::string("camera_info: ") + name +
                " has a last row that is not 0 0 1: it was never filled in, or is damaged");
  }
}

/// Size and pinhole of a region, in pixels of the whole sensor.
void cutOut(const sensor_msgs::RegionOfInterest& region, Camera& camera) {
  const auto isOut = [](std::uint32_t offset, std::uint32_t length, int size) {
    return std::uint64_t{offset} + length > static_cast<std::uint64_t>(size);
  };
  if (isOut(region.x_offset, region.width, camera.width) ||
      isOut(region.y_offset, region.height, camera.height)) {
    throw Error("camera_info: the roi of " + std::to_string(region.width) + " x " +
                std::to_string(region.height) + " pixels at (" + std::to_string(region.x_offset) +
                ", " + std::to_string(region.y_offset) + ") lies outside of its " +
                std::to_string(camera.width) + " x " + std::to_string(camera.height) +
                " pixels, which are those of the whole sensor");
  }
  camera.width = static_cast<int>(region.width);
  camera.height = static_cast<int>(region.height);
  camera.cx -= region.x_offset;
  camera.cy -= region.y_offset;
}

/// Pixels become the mean of `x` by `y` of them.
void bin(int x, int y, Camera& camera) {
  camera.width /= x;
  camera.height /= y;
  camera.fx /= x;
  camera.fy /= y;
  camera.cx = (camera.cx + 0.5) / x - 0.5;
  camera.cy = (camera.cy + 0.5) / y - 0.5;
}

}  // namespace

bool isRectifiedTopic(const std::string& topic) {
  return topic.find("/image_rect") != std::string::npos || topic.rfind("image_rect", 0) == 0;
}

Camera toCamera(const sensor_msgs::CameraInfo& message, bool rectified,
                const cv::Size& image_size) {
  sensor_msgs::CameraInfo info = message;
  const bool has_size = info.width > 0 || info.height > 0;
  if (!has_size) {  // as some drivers send it; then nothing is known of a region either
    info.width = static_cast<std::uint32_t>(image_size.width);
    info.height = static_cast<std::uint32_t>(image_size.height);
  }
  Camera camera;
  camera.width = static_cast<int>(info.width);
  camera.height = static_cast<int>(info.height);
  if (rectified) {
    setPinhole(camera, info.P.data(), 4, "P");
  } else {
    setPinhole(camera, info.K.data(), 3, "K");
    camera.distortion = toDistortion(info);
  }
  if (info.roi.width > 0 && info.roi.height > 0) cutOut(info.roi, camera);
  bin(std::max(1, static_cast<int>(info.binning_x)), std::max(1, static_cast<int>(info.binning_y)),
      camera);
  camera.validate();
  return camera;
}

sensor_msgs::CameraInfo toCameraInfo(const Camera& camera) {
  sensor_msgs::CameraInfo message;
  message.width = static_cast<std::uint32_t>(camera.width);
  message.height = static_cast<std::uint32_t>(camera.height);
  const Distortion& d = camera.distortion;
  if (d.model == LensModel::kEquidistant) {
    message.distortion_model = kEquidistantModel;
    message.D = {d.k1, d.k2, d.k3, d.k4};
  } else if (d.isRational()) {
    message.distortion_model = sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL;
    message.D = {d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6};
  } else {
    message.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
    message.D = {d.k1, d.k2, d.p1, d.p2, d.k3};
  }
  message.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

}  // namespace mivo
