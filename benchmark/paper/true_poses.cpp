// SPDX-License-Identifier: BSD-3-Clause
#include "true_poses.h"

#include <fmt/format.h>

#include <cmath>

#include "mivo/core/error.h"
#include "mivo/io/trajectory_io.h"

namespace mivo {

TruePoses::TruePoses(const std::string& path, double tolerance)
    : path_(path),
      tolerance_(tolerance),
      truth_(sortedByStamp(readTrajectory(path))),
      stamps_(stampsOf(truth_)) {}

const Eigen::Isometry3d& TruePoses::at(double stamp) const {
  const std::size_t i = nearestIndex(stamps_, stamp);
  if (std::abs(stamps_[i] - stamp) > tolerance_) {
    throw Error(fmt::format("{}: no pose near {:.6f}", path_, stamp));
  }
  return truth_[i].pose;
}

}  // namespace mivo
