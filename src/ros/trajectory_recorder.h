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

  /// Writes the kept poses. A relative path is resolved in trajectory_folder. Returns the path.
  /// Throws Error when there is no pose yet, or the file exists and may not be replaced.
  std::string save(const std::string& path, Overwrite overwrite) const;

  std::size_t size() const { return poses_.size(); }

 private:
  std::string resolve(const std::string& path) const;
  void openFile();

  NodeParameters parameters_;
  std::deque<StampedPose> poses_;
  std::unique_ptr<TrajectoryWriter> file_;
  int number_ = 1;  // of the file
};

}  // namespace mivo
