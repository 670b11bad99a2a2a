// SPDX-License-Identifier: BSD-3-Clause
#include "ros/trajectory_recorder.h"

#include <filesystem>

#include "io/numbered_path.h"
#include "mivo/core/error.h"

namespace mivo {

namespace fs = std::filesystem;

namespace {

void requireNew(const std::string& path, const char* remedy) {
  std::error_code
      ignored;  // what cannot be looked at will fail, with its reason, when it is created
  if (fs::exists(path, ignored)) throw Error(path + " exists: " + remedy);
}

/// Links and `..` are followed: a service is open to all who reach the master.
bool isInside(const std::string& path, const std::string& folder) {
  const fs::path whole = fs::weakly_canonical(fs::absolute(path));
  const fs::path root = fs::weakly_canonical(fs::absolute(folder));
  const fs::path relative = whole.lexically_relative(root);
  return !relative.empty() && *relative.begin() != "..";
}

bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code ignored;  // one that does not exist is another one
  return fs::equivalent(a, b, ignored);
}

}  // namespace

TrajectoryRecorder::TrajectoryRecorder(const NodeParameters& parameters) : parameters_(parameters) {
  openFile();
}

std::string TrajectoryRecorder::resolve(const std::string& path) const {
  return (fs::path(parameters_.trajectory_folder) / path).string();  // an absolute path stays
}

void TrajectoryRecorder::openFile() {
  file_.reset();
  if (parameters_.trajectory_file.empty()) return;
  const std::string path = numberedPath(resolve(parameters_.trajectory_file), number_);
  if (!parameters_.trajectory_force) {
    requireNew(path, "set another trajectory_file, or trajectory_force to replace it");
  }
  file_ = std::make_unique<TrajectoryWriter>(path, Overwrite::kYes);
  file_path_ = path;
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

std::string TrajectoryRecorder::pathToSave(const std::string& path, Overwrite overwrite) const {
  if (path.empty()) throw Error("the path of the trajectory is empty");
  if (poses_.empty()) throw Error("there is no pose to save yet");
  const std::string full_path = resolve(path);
  if (!isInside(full_path, parameters_.trajectory_folder)) {
    throw Error(full_path + " is outside of " + parameters_.trajectory_folder +
                ", the trajectory_folder of the node: choose a path inside");
  }
  if (file_ && isSameFile(full_path, file_path_)) {
    throw Error(full_path + " is the trajectory_file, which is being written: choose another name");
  }
  if (overwrite == Overwrite::kNo) {
    requireNew(full_path, kForceField);
  }
  return full_path;
}

}  // namespace mivo
