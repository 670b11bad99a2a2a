// SPDX-License-Identifier: BSD-3-Clause
#include "ros/trajectory_recorder.h"

#include <filesystem>

#include "io/numbered_path.h"
#include "mivo/core/error.h"

namespace mivo {

namespace fs = std::filesystem;

TrajectoryRecorder::TrajectoryRecorder(const NodeParameters& parameters) : parameters_(parameters) {
  openFile();
}

std::string TrajectoryRecorder::resolve(const std::string& path) const {
  return (fs::path(parameters_.trajectory_folder) / path).string();  // an absolute path stays
}

void TrajectoryRecorder::openFile() {
  file_.reset();
  if (parameters_.trajectory_file.empty()) return;
  file_ = std::make_unique<TrajectoryWriter>(
      numberedPath(resolve(parameters_.trajectory_file), number_),
      parameters_.trajectory_force ? Overwrite::kYes : Overwrite::kNo);
}

void TrajectoryRecorder::add(const StampedPose& pose) {
  poses_.push_back(pose);
  if (poses_.size() > static_cast<std::size_t>(parameters_.trajectory_length)) poses_.pop_front();
  if (file_) file_->write(pose);
}

void TrajectoryRecorder::startAnew() {
  if (poses_.empty()) return;
  poses_.clear();
  ++number_;
  openFile();
}

std::string TrajectoryRecorder::save(const std::string& path, Overwrite overwrite) const {
  if (path.empty()) throw Error("the path of the trajectory is empty");
  if (poses_.empty()) throw Error("there is no pose to save yet");
  const std::string full_path = resolve(path);
  TrajectoryWriter writer(full_path, overwrite);
  for (const StampedPose& pose : poses_) writer.write(pose);
  return full_path;
}

}  // namespace mivo
