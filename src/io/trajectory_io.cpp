// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/trajectory_io.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "io/trajectory_format.h"
#include "mivo/core/error.h"

namespace mivo {
std::string trajectoryLine(const StampedPose& pose) {
  const Eigen::Vector3d t = pose.pose.translation();
  Eigen::Quaterniond q(pose.pose.linear());
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();  // one of the two that mean the same rotation
  return fmt::format("{:.6f} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g}\n", pose.stamp,
                     t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

Trajectory readTrajectory(const std::string& path) {
  return readTrajectoryFile(path).poses;
}

TrajectoryWriter::TrajectoryWriter(const std::string& path, Overwrite overwrite)
    : file_(path, overwrite) {
  file_.write("# stamp tx ty tz qx qy qz qw\n");
}

void TrajectoryWriter::write(const StampedPose& pose) {
  if (!std::isfinite(pose.stamp) || !pose.pose.matrix().allFinite()) {
    throw Error("a pose for " + file_.path() + " is not finite");
  }
  file_.write(trajectoryLine(pose));
}

void writeTrajectory(const std::string& path, const Trajectory& trajectory, Overwrite overwrite,
                     const char* remedy) {
  namespace fs = std::filesystem;
  refuseExisting(path, overwrite, remedy);
  const std::string part = path + ".part";
  std::error_code error;
  try {
    TrajectoryWriter writer(part, Overwrite::kYes);
    for (const StampedPose& pose : trajectory) writer.write(pose);
  } catch (const Error&) {
    fs::remove(part, error);  // what is wrong is known already
    throw;
  }
  fs::rename(part, path, error);
  if (error) throw Error("cannot rename " + part + " to " + path + ": " + error.message());
}

}  // namespace mivo
