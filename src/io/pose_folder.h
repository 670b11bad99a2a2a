// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/trajectory_format.h"

namespace mivo {

/// The true path that a sequence folder holds: groundtruth.txt, or a matrix of 4 x 4 numbers for
/// each frame, from the camera to the world, as 7-Scenes and 3DMatch have them
/// (frame-000000.pose.txt) and ScanNet (pose/0.txt). Their stamps are those that run_sequence gives
/// to the images. Matrices that are not finite mark frames without a pose. Throws Error when there
/// is none of these, or a matrix is no pose.
TrajectoryFile readPoseFolder(const std::string& folder);

/// Whether a folder holds any of these files.
bool hasPoses(const std::string& folder);

}  // namespace mivo
