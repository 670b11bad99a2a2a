// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>

#include <Eigen/Geometry>

namespace mivo {

/// Quaternions are of unit length, with w not negative.
geometry_msgs::Pose toPose(const Eigen::Isometry3d& T);
geometry_msgs::Transform toTransform(const Eigen::Isometry3d& T);

/// Throws Error for numbers that are not finite, or a quaternion whose length is not within a tenth
/// of one; otherwise it is normalized.
Eigen::Isometry3d toIsometry(const geometry_msgs::Pose& pose);
Eigen::Isometry3d toIsometry(const geometry_msgs::Transform& transform);

}  // namespace mivo
