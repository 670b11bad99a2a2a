// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// A trajectory as it was read.
struct TrajectoryFile {
  Trajectory poses;                  ///< in the order of the file
  std::vector<std::string> notices;  ///< what was recognized that is not plain
  bool is_order_assumed = false;     ///< nothing in the file says that qw is the last number
};

/// The rotation nearest to a matrix that is one but for rounding; nothing when it is none.
std::optional<Eigen::Matrix3d> nearestRotation(const Eigen::Matrix3d& matrix);

/// Reads any of
///   TUM          `stamp tx ty tz qx qy qz qw`
///   EuRoC        commas and 17 columns, or 8 with nanoseconds of today; qw first
///   a heading    a line of names, after a # or not: columns are taken by their names
///   KITTI        12 numbers, the upper rows of the pose's matrix; stamps are the numbers of the
///   poses ROS 2 CSV    `sec,nanosec,frame,...,x,y,z,qx,qy,qz,qw,...`, as `ros2 topic echo --csv`
///   prints it
/// Stamps may be seconds, milli-, micro- or nanoseconds, see stampUnit(). Quaternions are
/// normalized when they are within a tenth of unit length. Throws Error, naming file and line, for
/// anything else, and when there is no pose at all.
TrajectoryFile readTrajectoryFile(const std::string& path);

}  // namespace mivo
