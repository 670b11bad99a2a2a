// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "mivo/core/camera.h"
#include "mivo/io/output_file.h"

namespace mivo {

/// Content of `camera.txt` of a sequence folder.
struct SequenceCamera {
  Camera camera;
  double depth_units_per_meter = 1000.0;
};

/// Reads `#` comments and one line `width height fx fy cx cy depth_units_per_meter` with
/// `[k1 k2 p1 p2 k3 [k4 k5 k6]]` or `[equidistant k1 k2 k3 k4]` behind it, see Distortion. Throws
/// Error naming file and line.
SequenceCamera readCamera(const std::string& path);

/// Throws Error when the file exists and may not be replaced, or cannot be written.
void writeCamera(const std::string& path, const SequenceCamera& camera, Overwrite overwrite);

/// The published color camera of a TUM RGB-D sequence if the folder's name contains freiburg1,
/// freiburg2 or freiburg3.
std::optional<SequenceCamera> tumCamera(const std::string& folder_name);

}  // namespace mivo
