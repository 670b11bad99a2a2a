// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <vector>

#include "ros/camera_parameters.h"

namespace mivo {

/// Static transforms from the link to the color and depth cameras and their optical frames, with
/// the distances between the lenses of an Xtion Pro Live as ROS drivers have them.
std::vector<geometry_msgs::TransformStamped> cameraTransforms(const CameraParameters& parameters);

}  // namespace mivo
