// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>

#include "evaluation/relative_pose_error.h"
#include "mivo/core/odometry.h"
#include "synthetic/sequence_generator.h"

namespace mivo {
namespace testing {

/// Changes frame i of a path, or takes it away: false.
using ChangeFrame = std::function<bool(int i, Frame& frame)>;

/// Tracks an office, along two paths, and compares with the truth: what is changed shows against
/// the twin without the change.
/// @return  root mean square of the relative errors over half a second, m
inline double relativeErrorIn(
    const Camera& camera, const ChangeFrame& change = [](int, Frame&) { return true; }) {
  constexpr double kSeconds = 0.5;
  double squares = 0.0;
  std::size_t count = 0;
  for (const std::uint64_t seed : {1U, 2U}) {
    GeneratorOptions options;
    options.scene = "office";
    options.frames = 40;
    options.seed = seed;
    options.camera = camera;
    options.sensor.samples = 2;
    SequenceGenerator generator(options);
    Odometry odometry(camera, {});
    Trajectory truth;
    Trajectory estimate;
    for (int i = 0; !generator.atEnd(); ++i) {
      const SyntheticFrame filmed = generator.next();
      Frame frame;
      frame.stamp = filmed.stamp;
      frame.image = toGray(filmed.color, ChannelOrder::kBgr);
      frame.depth = filmed.depth;
      frame.depth_unit = 1.0 / options.sensor.depth.units_per_meter;
      if (!change(i, frame)) continue;
      const TrackingResult& result = odometry.process(frame);
      EXPECT_EQ(result.state, TrackingState::kTracking);
      truth.push_back({filmed.stamp, filmed.T_world_camera});
      estimate.push_back({filmed.stamp, result.T_odom_camera});
    }
    for (const RelativePoseError& error : relativePoseErrors(truth, estimate, kSeconds, 0.001)) {
      squares += error.translation * error.translation;
      ++count;
    }
  }
  return std::sqrt(squares / static_cast<double>(count));
}

}  // namespace testing
}  // namespace mivo
