// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "frame_faults.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Frames in memory, with their true poses.
struct TrueRecording {
  std::vector<Delivery> deliveries;
  std::vector<Eigen::Isometry3d> T_world_camera;  ///< one for each
};

/// A third of a recording is delivered as it is, the second third with a fault, the rest as it is.
struct FaultRun {
  std::string fault;
  double rate = 1.0;  ///< part of the frames that it hits
  std::uint32_t seed = 0;
};

/// What became of it.
struct FaultOutcome {
  double longest = 0.0;  ///< s of processor time for one frame
  int wrong = 0;         ///< frames of state tracking that were off by more than the limits below
  int overconfident =
      0;  ///< frames of state tracking off by more than five of their own deviations
  /// Frames from the fault's end until the pose is tracked and right again; all that are left when
  /// it never is.
  int recovery = 0;
};

constexpr double kWrongDistance = 0.1;                          // m, since the start of the segment
constexpr double kWrongAngle = 5.0 * 3.14159265358979 / 180.0;  // rad
constexpr double kWrongDeviations = 5.0;

/// Tracks a recording under a fault, as the node does. What is thrown out of it is a crash.
FaultOutcome track(const TrueRecording& recording, const FaultRun& run,
                   const Parameters& parameters);

}  // namespace mivo
