// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "mivo/io/trajectory_io.h"
#include "mivo/trajectory/stamped_pose.h"
#include "ros/node_parameters.h"

namespace mivo {

/// Keeps the poses of the camera since the last start for the service, and optionally writes them
/// to a file immediately.
class TrajectoryRecorder {
 public:
  /// Throws Error when the file of the parameters exists already or cannot be written.
  explicit TrajectoryRecorder(const NodeParameters& parameters);

  /// Throws Error when the file cannot be written; the pose is kept nevertheless.
  void add(const StampedPose& pose);

  /// Starts a new trajectory after a reset or when time was set back. The current file is complete;
  /// the next one is name_2.txt after name.txt. Throws Error when it cannot be written.
  void startAnew();

  /// What a caller of the service can do about a file that exists.
  static constexpr const char* kForceField = "choose another name, or set force to replace it";

  /// The file for a path inside of trajectory_folder. Throws Error when there is no pose yet, when
  /// the file exists and may not be replaced, or is the one that is being written.
  std::string pathToSave(const std::string& path, Overwrite overwrite) const;

  /// The kept poses.
  Trajectory poses() const { return {poses_.begin(), poses_.end()}; }

 private:
  std::string resolve(const std::string& path) const;
  void openFile();

  NodeParameters parameters_;
  std::deque<StampedPose> poses_;
  std::unique_ptr<TrajectoryWriter> file_;
  std::string file_path_;
  int number_ = 1;  // of the file
};

}  // namespace mivo
