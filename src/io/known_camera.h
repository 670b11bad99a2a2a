// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "mivo/io/camera_file.h"

namespace mivo {

/// A calibration that the makers of a collection of recordings have published.
struct KnownCamera {
  std::string whose;  ///< "TUM's sequences"
  SequenceCamera camera;
};

/// Of the sequences whose folders have a name that tells: TUM's freiburg1, 2 and 3, Bonn's
/// rgbd_bonn.
std::optional<KnownCamera> cameraByName(const std::string& folder_name);

/// Of ICL-NUIM, with the y axis down.
SequenceCamera iclCamera();

/// Of 7-Scenes: what its makers took for the depth camera; color is not registered to it.
SequenceCamera sevenScenesCamera();

/// In words: "fx 525 fy 525 cx 319.5 cy 239.5, 1000 depth units per meter".
std::string describe(const SequenceCamera& camera);

}  // namespace mivo
