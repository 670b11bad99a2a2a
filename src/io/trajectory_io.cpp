// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/trajectory_io.h"

#include <fmt/format.h>

#include <cmath>

#include "io/table_reader.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr std::size_t kFields = 8;

// Files written by hand round quaternions to 3 or 4 digits; a tenth off is another quantity.
constexpr double kNormTolerance = 0.1;

}  // namespace

std::string trajectoryLine(const StampedPose& pose) {
  const Eigen::Vector3d t = pose.pose.translation();
  Eigen::Quaterniond q(pose.pose.linear());
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();  // one of the two that mean the same rotation
  return fmt::format("{:.6f} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g}\n", pose.stamp,
                     t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

Trajectory readTrajectory(const std::string& path) {
  Trajectory trajectory;
  TableReader table(path);
  while (table.next()) {
    if (table.size() != kFields) {
      table.refuse("expected 8 numbers 'stamp tx ty tz qx qy qz qw', found " +
                   std::to_string(table.size()));
    }
    StampedPose pose;
    pose.stamp = table.number(0);
    pose.pose.translation() << table.number(1), table.number(2), table.number(3);
    Eigen::Quaterniond q(table.number(7), table.number(4), table.number(5), table.number(6));
    if (!(std::abs(q.norm() - 1.0) <= kNormTolerance)) {
      table.refuse(fmt::format("the quaternion has length {:.4g} instead of 1", q.norm()));
    }
    pose.pose.linear() = q.normalized().toRotationMatrix();
    trajectory.push_back(pose);
  }
  if (trajectory.empty()) throw Error(path + " holds no pose");
  return trajectory;
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

}  // namespace mivo
