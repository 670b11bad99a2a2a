// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "support/scene.h"

namespace mivo::testing {

constexpr double kFramePeriod = 1.0 / 30.0;

/// A sequence with its true poses, the first one the identity.
struct Recording {
  Camera camera;
  std::vector<Frame> frames;
  std::vector<Eigen::Isometry3d> T_first_camera;
};

/// A smooth walk through the room, 1.2 cm and 1.5 degrees a frame, at 30 Hz from stamp 10 s.
inline Recording recordWalk(int num_frames, const Camera& camera = smallCamera()) {
  Recording recording;
  recording.camera = camera;
  const Eigen::Isometry3d T_world_first =
      retract((Vector6() << -0.2, 0.1, -0.4, 0.05, -0.1, 0.0).finished());
  for (int i = 0; i < num_frames; ++i) {
    const double t = 0.08 * i;
    Vector6 d;
    d << 0.15 * std::sin(t), 0.06 * (1.0 - std::cos(t)), 0.1 * std::sin(0.7 * t),
        0.1 * std::sin(0.6 * t), 0.3 * std::sin(t), 0.1 * (1.0 - std::cos(0.8 * t));
    recording.T_first_camera.push_back(retract(d));
    Frame frame = render(roomScene(), camera, T_world_first * retract(d));
    frame.stamp = 10.0 + kFramePeriod * i;
    recording.frames.push_back(frame);
  }
  return recording;
}

}  // namespace mivo::testing
