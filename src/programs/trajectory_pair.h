// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// A trajectory with the truth that it is compared with.
struct TrajectoryPair {
  Trajectory truth;
  Trajectory estimate;
  std::vector<std::string> notices;  ///< how the files were read, where that is not plain
};

/// Reads both files, see readTrajectoryFile(); the truth may be the sequence folder that holds it,
/// see readPoseFolder(). A file that does not say how its quaternions are
/// ordered is read with qw last, unless its motion fits the other file's far better with qw first:
/// which of the two makes a smooth path cannot be seen in one file alone, for both turn by the same
/// angles. Throws Error.
TrajectoryPair readTrajectoryPair(const std::string& truth_path, const std::string& estimate_path);

}  // namespace mivo
