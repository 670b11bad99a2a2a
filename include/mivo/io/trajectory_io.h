// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mivo/io/output_file.h"
#include "mivo/trajectory/stamped_pose.h"

// Trajectories as text: lines `stamp tx ty tz qx qy qz qw`, the pose of the color optical frame in
// the world in meters, `#` for comments.

namespace mivo {

/// The line of one pose, with its end of line: 6 decimals of the stamp, 12 digits of the pose, and
/// the quaternion whose qw is not negative.
std::string trajectoryLine(const StampedPose& pose);

/// Poses in the order of the file, whose format may also be EuRoC, KITTI or a CSV of ROS, see
/// doc/file_formats.md. Quaternions whose norm deviates from 1 by at most 10 % are normalized.
/// Throws Error, naming file and line, for anything that is not 8 finite numbers or no rotation,
/// and when there is no pose at all.
Trajectory readTrajectory(const std::string& path);

/// Writes a trajectory pose by pose; each is in the file when `write` has returned.
class TrajectoryWriter {
 public:
  /// Throws Error when the file exists and may not be replaced, or cannot be created.
  TrajectoryWriter(const std::string& path, Overwrite overwrite);

  /// Throws Error when the pose is not finite or cannot be written.
  void write(const StampedPose& pose);

 private:
  OutputFile file_;
};

/// Writes a trajectory at once: under its name the file is complete or as it was before. Throws
/// Error as TrajectoryWriter does; for a file that exists it ends with `remedy`.
void writeTrajectory(const std::string& path, const Trajectory& trajectory, Overwrite overwrite,
                     const char* remedy = kForceOption);

}  // namespace mivo
