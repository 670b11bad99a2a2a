// SPDX-License-Identifier: BSD-3-Clause
#include "core/shutter/shutter_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mivo/core/odometry.h"
#include "support/camera_path.h"

namespace mivo {
namespace {

using testing::kFramePeriod;

class ShutterModelTest : public ::testing::Test {
 protected:
  ShutterModelTest() { parameters_.depth_time_offset_estimation = true; }

  /// Keyframes that measure the same offset, in periods relative to the initial one.
  void keyframes(double offset, int count = 10) {
    const double at_first = depthOffset();
    for (int i = 0; i < count; ++i) {
      Alignment alignment;
      alignment.depth_offset = {at_first + offset - depthOffset(), 80.0};
      for (int frame = 0; frame < 4; ++frame) model_.add(alignment);
      model_.endKeyframe(parameters_, kFramePeriod);
    }
  }
  double depthOffset() const { return model_.times(parameters_, kFramePeriod).depth_offset; }

  ShutterParameters parameters_;
  ShutterModel model_;
};

TEST_F(ShutterModelTest, WhatIsGivenHolds) {
  parameters_.rolling_shutter_readout = 0.02;
  parameters_.depth_time_offset = -0.01;
  const ShutterTimes times = model_.times(parameters_, kFramePeriod);
  EXPECT_NEAR(times.readout, 0.6, 1e-12);
  EXPECT_NEAR(times.depth_offset, -0.3, 1e-12);
  // Without a known frame period, fractions of it are unknown.
  EXPECT_EQ(model_.times(parameters_, 0.0).readout, 0.0);
  EXPECT_EQ(model_.times(parameters_, 0.0).depth_offset, 0.0);
}

TEST_F(ShutterModelTest, TheEstimateStartsAtWhatIsGiven) {
  parameters_.depth_time_offset = -0.01;
  keyframes(0.05);
  EXPECT_NEAR(depthOffset(), -0.3, 1e-12);
  keyframes(0.6, 30);
  EXPECT_NEAR(depthOffset(), 0.3, 0.05);
}

TEST_F(ShutterModelTest, AnotherOneGivenStartsItAnew) {
  keyframes(0.3);
  ASSERT_GT(depthOffset(), 0.2);
  parameters_.depth_time_offset = 0.02;
  model_.endKeyframe(parameters_, kFramePeriod);
  EXPECT_NEAR(depthOffset(), 0.6, 1e-12);
}

TEST_F(ShutterModelTest, NobodyIsToldWhatWasNotAskedFor) {
  keyframes(0.3);
  parameters_.depth_time_offset_estimation = false;
  EXPECT_EQ(depthOffset(), 0.0);
}

constexpr int kFrames = 50;

/// A shaking camera whose depth is taken `offset` s later than color.
std::vector<Frame> filmShaken(double offset) {
  const auto poseAt = [](double t) {
    Vector6 d;
    d << 0.1 * std::sin(3.0 * t), 0.04 * std::sin(4.0 * t), 0.06 * std::sin(2.5 * t),
        0.12 * std::sin(5.0 * t), 0.25 * std::sin(4.0 * t), 0.12 * std::sin(6.0 * t);
    return retract(d);
  };
  const testing::Scene scene = testing::roomScene();
  std::vector<Frame> frames;
  for (int i = 0; i < kFrames; ++i) {
    const double t = i * kFramePeriod;
    frames.push_back(testing::render(scene, testing::smallCamera(), poseAt(t)));
    if (offset != 0.0) {
      frames.back().depth =
          testing::render(scene, testing::smallCamera(), poseAt(t + offset)).depth;
    }
    frames.back().stamp = 10.0 + t;
  }
  return frames;
}

/// The depth offset that the odometry estimates from them, s.
double offsetFound(const std::vector<Frame>& frames, bool is_wanted) {
  Parameters parameters;
  parameters.shutter.depth_time_offset_estimation = is_wanted;
  Odometry odometry(testing::smallCamera(), parameters);
  for (const Frame& frame : frames) {
    const double before = odometry.result().depth_time_offset;
    const TrackingResult& result = odometry.process(frame);
    EXPECT_NE(result.state, TrackingState::kLost) << frame.stamp;
    if (!result.new_keyframe) {
      EXPECT_NEAR(result.depth_time_offset, before, 1e-9) << "it changes with keyframes only";
    }
  }
  return odometry.result().depth_time_offset;
}

TEST(DepthOffsetTrackingTest, AnOffsetIsFoundWhileTrackingIfThatIsAskedFor) {
  for (const double offset : {-0.01, 0.01}) {
    const std::vector<Frame> frames = filmShaken(offset);
    EXPECT_NEAR(offsetFound(frames, true), offset, 0.003) << offset;
    EXPECT_EQ(offsetFound(frames, false), 0.0);
  }
}

TEST(DepthOffsetTrackingTest, WithoutOneItStaysZero) {
  EXPECT_EQ(offsetFound(filmShaken(0.0), true), 0.0);
}

}  // namespace
}  // namespace mivo
