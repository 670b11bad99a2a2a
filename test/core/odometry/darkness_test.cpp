// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "mivo/core/odometry.h"
#include "support/camera_path.h"

// Odometry when the light is switched off during motion, and on again.

namespace mivo {
namespace {

constexpr int kDarkFrom = 8;
constexpr int kLitFrom = 32;
constexpr int kFrames = 40;
constexpr double kTurn = 0.03;  // rad per frame

/// The camera turns by 70 degrees, mostly in the dark: when the light is back, nothing of the first
/// view is visible.
class DarknessTest : public ::testing::Test {
 protected:
  static Eigen::Isometry3d pose(int i) {
    return retract((Vector6() << 0.004 * i, 0.0, 0.002 * i, 0.002 * i, kTurn * i, 0.0).finished());
  }

  Frame frame(int i) const {
    Frame frame = testing::render(testing::roomScene(), camera_, T_world_first_ * pose(i));
    if (i >= kDarkFrom && i < kLitFrom) frame.image.setTo(2);
    frame.stamp = 10.0 + testing::kFramePeriod * i;
    return frame;
  }

  static Vector6 errorOf(const TrackingResult& result, int i) {
    return localCoordinates(result.T_odom_camera.inverse() * pose(i));
  }

  Camera camera_ = testing::smallCamera();
  Eigen::Isometry3d T_world_first_ =
      retract((Vector6() << 0.3, 0.4, 0.2, -0.55, -0.9, 0.0).finished());
  Odometry odometry_{camera_, {}};
};

TEST_F(DarknessTest, DepthLeadsOnHoweverFarTheCameraTurnsMeanwhile) {
  for (int i = 0; i < kFrames; ++i) {
    const TrackingResult& result = odometry_.process(frame(i));
    const bool is_dark = i >= kDarkFrom && i < kLitFrom;
    // The first frame with light is aligned with a keyframe from the dark.
    const bool is_blind = is_dark || i == kLitFrom;
    EXPECT_EQ(result.state, is_blind ? TrackingState::kDegraded : TrackingState::kTracking) << i;
    EXPECT_EQ(result.segment, 0) << i;
    EXPECT_LT(errorOf(result, i).tail<3>().norm(), 0.01) << i;
    // With two walls in view, motion along their edge is open and continues at the previous
    // velocity.
    EXPECT_LT(errorOf(result, i).head<3>().norm(), 0.12) << i;
    if (i == kLitFrom) {
      EXPECT_TRUE(result.new_keyframe);
    }
  }
}

// The keyframe is from the dark, and depth alone does not find the previous place again: it is
// searched as soon as there is light and the camera can have reached it.
TEST_F(DarknessTest, BackInTheLightAndInAKnownPlaceItIsFound) {
  for (int i = 0; i < kLitFrom; ++i) odometry_.process(frame(i));
  ASSERT_GT(odometry_.result().keyframes, 2);
  Frame known = frame(kDarkFrom - 1);
  known.depth.setTo(0.0F);
  for (int i = kLitFrom; i < kLitFrom + odometry_.parameters().loss.lost_frames - 1; ++i) {
    known.stamp = 10.0 + testing::kFramePeriod * i;
    odometry_.process(known);
  }
  EXPECT_EQ(odometry_.result().state, TrackingState::kTracking);
  EXPECT_EQ(odometry_.result().segment, 0);
  EXPECT_LT(errorOf(odometry_.result(), kDarkFrom - 1).norm(), 0.02);
}

// A dark image shows a little of the scene, and much noise: enough to be used, too little to be
// trusted. Depth sees what the image leaves open, as here that the camera turns back.
TEST_F(DarknessTest, WhatADarkImageLeavesOpenDepthSees) {
  constexpr double kDim = 0.02;
  constexpr double kNoise = 5.0;  // gray levels
  for (int i = 0; i < 2 * kDarkFrom; ++i) {
    const int at = std::min(i, 2 * kDarkFrom - i);
    Frame here = testing::render(testing::roomScene(), camera_, T_world_first_ * pose(at));
    here.stamp = 10.0 + testing::kFramePeriod * i;
    if (i >= kDarkFrom) {
      here.image *= kDim;
      here = testing::withNoise(here, kNoise, static_cast<std::uint64_t>(i));
    }
    const TrackingResult& result = odometry_.process(here);
    // Depth alone is never called tracking.
    EXPECT_EQ(result.state, i < kDarkFrom ? TrackingState::kTracking : TrackingState::kDegraded)
        << i;
    EXPECT_NE(result.reason, TrackingReason::kOpenDirections) << i;
    EXPECT_LT(errorOf(result, at).head<3>().norm(), 0.03) << i;
    EXPECT_LT(errorOf(result, at).tail<3>().norm(), 0.01) << i;
  }
}

TEST_F(DarknessTest, WithoutDepthItIsLostMeanwhile) {
  for (int i = 0; i < kLitFrom; ++i) {
    Frame here = frame(i);
    if (i >= kDarkFrom) here.depth.setTo(0.0F);
    const TrackingResult& result = odometry_.process(here);
    EXPECT_EQ(result.state, i < kDarkFrom ? TrackingState::kTracking : TrackingState::kLost) << i;
  }
}

}  // namespace
}  // namespace mivo
