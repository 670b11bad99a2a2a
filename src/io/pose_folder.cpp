// SPDX-License-Identifier: BSD-3-Clause
#include "io/pose_folder.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <optional>

#include "io/sequence_layout.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

/// A number of a text, which may be inf or nan: ScanNet has -inf where its mapping was lost.
double toNumber(const std::string& text, const fs::path& file) {
  std::size_t end = 0;
  try {
    const double value = std::stod(text, &end);
    if (end == text.size()) return value;
  } catch (const std::exception&) {
    // Told below, as what is not a number to its end.
  }
  throw Error(fmt::format("{}: '{}' is no number", file.string(), text));
}

/// Nothing where the frame has no pose.
std::optional<Eigen::Isometry3d> readPose(const fs::path& file) {
  std::ifstream stream(file);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  std::string text;
  int count = 0;
  for (; stream >> text; ++count) {
    if (count < 16) matrix(count / 4, count % 4) = toNumber(text, file);
  }
  if (count != 12 && count != 16) {
    throw Error(
        fmt::format("{}: expected 16 numbers of a pose's matrix, found {}", file.string(), count));
  }
  if (!matrix.allFinite()) return std::nullopt;
  const auto rotation = nearestRotation(matrix.topLeftCorner<3, 3>());
  if (!rotation) throw Error(file.string() + ": the matrix has no rotation in its first columns");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = *rotation;
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

std::map<long, fs::path> poseFiles(const std::string& folder) {
  auto files = numberedFiles(folder, {".pose.txt"});
  return files.empty() ? numberedFiles(fs::path(folder) / "pose", {".txt"}) : files;
}

fs::path groundTruth(const std::string& folder) {
  return fs::path(folder) / "groundtruth.txt";
}

}  // namespace

bool hasPoses(const std::string& folder) {
  return fs::exists(groundTruth(folder)) || !poseFiles(folder).empty();
}

TrajectoryFile readPoseFolder(const std::string& folder) {
  const fs::path file = groundTruth(folder);
  if (fs::exists(file)) return readTrajectoryFile(file.string());
  TrajectoryFile result;
  for (const auto& [number, path] : poseFiles(folder)) {
    const auto pose = readPose(path);
    if (pose) result.poses.push_back({static_cast<double>(number) / kAssumedFrameRate, *pose});
  }
  if (result.poses.empty()) {
    throw Error(folder +
                " holds no true path: neither groundtruth.txt (TUM) nor frame-000000.pose.txt "
                "(7-Scenes) nor pose/0.txt (ScanNet)");
  }
  result.notices.push_back(
      fmt::format("{}: {} poses in a file each; they have no times: {:g} Hz are assumed, as by "
                  "run_sequence",
                  folder, result.poses.size(), kAssumedFrameRate));
  return result;
}

}  // namespace mivo
