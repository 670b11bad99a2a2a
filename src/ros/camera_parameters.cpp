// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mivo/core/error.h"
#include "ros/ros_parameter.h"

namespace mivo {
namespace {

constexpr double kPairFraction = 0.4;  // of the frame period: less than half, so never ambiguous
constexpr std::array<double, 2> kDepthUnits{0.001, 0.0001};  // m
constexpr double kUnitPrecision = 1e-9;

void checkDepthUnit(double unit) {
  const bool known = std::any_of(kDepthUnits.begin(), kDepthUnits.end(), [&](double candidate) {
    return std::abs(unit - candidate) < kUnitPrecision;
  });
  if (!known) {
    throw Error("parameter depth_unit is " + std::to_string(unit) +
                ", but OpenNI2 has depth in steps of 0.001 m and 0.0001 m only");
  }
}

}  // namespace

CameraParameters readCameraParameters(const ros::NodeHandle& node) {
  CameraParameters parameters;
  DeviceRequest& device = parameters.device;
  readParameter(node, "device", device.address);
  readParameter(node, "width", device.width, 80, 4096);
  readParameter(node, "height", device.height, 60, 4096);
  readParameter(node, "rate", device.rate, 1, 240);
  readParameter(node, "depth_unit", device.depth_unit, 0.0, 1.0);
  checkDepthUnit(device.depth_unit);
  readParameter(node, "depth_registration", device.registration);
  readParameter(node, "depth_synchronization", device.synchronize);
  readParameter(node, "repeat", device.repeat);
  readParameter(node, "warm_up_images", parameters.times.warm_up_images, 0, 1000);
  readParameter(node, "frame_prefix", parameters.frame_prefix);
  readParameter(node, "rgb_camera_info_url", parameters.rgb_camera_info_url);
  readParameter(node, "depth_camera_info_url", parameters.depth_camera_info_url);
  readParameter(node, "publish_tf", parameters.publish_tf);
  readParameter(node, "pair_tolerance", parameters.pair_tolerance, 0.0, 1.0);
  if (parameters.pair_tolerance == 0.0) {
    parameters.pair_tolerance = kPairFraction / device.rate;
  }
  return parameters;
}

}  // namespace mivo
