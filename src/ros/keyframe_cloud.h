// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Geometry>
#include <vector>

#include "mivo/core/odometry.h"
#include "ros/image_conversion.h"

namespace mivo {

/// The points of a keyframe, moved by T: x, y, z in m, rgb, and the gray intensity of the tracker.
/// @param color  of the keyframe; where it has no colors of 8 bits, points are gray
sensor_msgs::PointCloud2Ptr toCloud(const std::vector<CloudPoint>& points,
                                    const Eigen::Isometry3d& T, const ColorImage& color);

}  // namespace mivo
