// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "mivo/io/trajectory_io.h"
#include "mivo/trajectory/stamped_pose.h"
#include "ros/node_parameters.h"

namespace mivo {

/// Keeps the poses of the camera since the last start for the service, and writes them to a file
/// while they come when the parameters ask for it.
class TrajectoryRecorder {
 public:
  /// Throws Error when the file of the parameters exists already or cannot be written.
  explicit TrajectoryRecorder(const NodeParameters& parameters);

  /// Throws Error when the file cannot be written; the pose is kept all the same.
  void add(const StampedPose& pose);

  /// A new trajectory, which is not the continuation of the last: after a reset, or when time was
  /// set back. The file is complete; the next pose begins another one, name_2.txt after name.txt.
  /// Throws Error when that one cannot be written.
  void startAnew();

  /// Writes what was kept. A relative path lies in the trajectory_folder. Returns the path. Throws
  /// Error when there is no pose yet, or the file exists and may not be replaced.
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
