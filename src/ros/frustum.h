// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Point.h>

#include <Eigen/Geometry>
#include <vector>

#include "mivo/core/camera.h"

namespace mivo {

geometry_msgs::Point toPoint(const Eigen::Vector3d& v);

/// Adds the edges of the pyramid that a camera at T sees, as pairs of points.
/// @param depth  of the pyramid, m
void addFrustum(const Camera& camera, const Eigen::Isometry3d& T, double depth,
                std::vector<geometry_msgs::Point>& points);

}  // namespace mivo
