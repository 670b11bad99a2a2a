// SPDX-License-Identifier: BSD-3-Clause
#include "io/known_camera.h"

#include <fmt/format.h>

namespace mivo {

std::optional<KnownCamera> cameraByName(const std::string& folder_name) {
  if (const auto tum = tumCamera(folder_name)) return KnownCamera{"TUM's sequences", *tum};
  if (folder_name.find("rgbd_bonn") == std::string::npos) return std::nullopt;
  // https://www.ipb.uni-bonn.de/data/rgbd-dynamic-dataset, section on the intrinsics.
  return KnownCamera{"Bonn's dynamic sequences",
                     {{640,
                       480,
                       542.822841,
                       542.576870,
                       315.593520,
                       237.756098,
                       {0.039903, -0.099343, -0.000730, -0.000144, 0.0}},
                      5000.0}};
}

SequenceCamera iclCamera() {
  // https://www.doc.ic.ac.uk/~ahanda/VaFRIC/codes.html has fy = -480: its y axis points up.
  return {{640, 480, 481.20, 480.00, 319.50, 239.50, {}}, 5000.0};
}

SequenceCamera sevenScenesCamera() {
  // https://www.microsoft.com/en-us/research/project/rgb-d-dataset-7-scenes
  return {{640, 480, 585.0, 585.0, 320.0, 240.0, {}}, 1000.0};
}

std::string describe(const SequenceCamera& camera) {
  const Camera& c = camera.camera;
  return fmt::format("fx {} fy {} cx {} cy {}, {} depth units per meter", c.fx, c.fy, c.cx, c.cy,
                     camera.depth_units_per_meter);
}

}  // namespace mivo
