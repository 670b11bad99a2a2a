// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in all formats.
#include <cmath>
#include <cstdlib>

#include "fuzz/fuzz_file.h"
#include "io/trajectory_format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static mivo::FuzzFile file;
  mivo::expectErrorOrSuccess([&] {
    for (const auto& pose : mivo::readTrajectoryFile(file.holding(bytes, count)).poses) {
      if (!std::isfinite(pose.stamp) || !pose.pose.matrix().allFinite()) std::abort();
    }
  });
  return 0;
}
