// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mivo/core/odometry.h"
#include "support/camera_path.h"
#include "support/wall.h"

// Odometry where image and depth do not constrain some directions of motion.

namespace mivo {
namespace {

using testing::Paint;
using testing::Wall;

constexpr double kSpeed = 0.2;  // m/s, to the right

Parameters methodOfThePaper() {
  Parameters parameters;
  parameters.alignment.photometric_model = PhotometricModel::kNone;
  parameters.geometry.geometric_term = false;
  parameters.shutter.rolling_shutter_estimation = false;
  parameters.motion.hold_coarse_levels = false;
  parameters.loss.surprise_deviations = 1e6;
  return parameters;
}

double stampOf(int i) {
  return 10.0 + testing::kFramePeriod * i;
}

/// Position of the camera along x, relative to the first frame.
double slidden(int i) {
  return kSpeed * testing::kFramePeriod * i;
}

Vector6 errorAt(const TrackingResult& result, double x) {
  return localCoordinates(result.T_odom_camera.inverse() * retract(x * Vector6::Unit(0)));
}

double sigma(const TrackingResult& result, int axis) {
  return std::sqrt(result.covariance(axis, axis));
}

/// The error is within three standard deviations along the motion, and within five along the other
/// axes: of that many numbers some exceed three.
void expectHonest(const TrackingResult& result, double x, int frame) {
  const Vector6 error = errorAt(result, x);
  EXPECT_LT(std::abs(error[0]), 3.0 * sigma(result, 0)) << "frame " << frame;
  for (int k = 1; k < 6; ++k) {
    EXPECT_LT(std::abs(error[k]), 5.0 * sigma(result, k)) << "axis " << k << " frame " << frame;
  }
}

/// The camera moves along the stripes; in the observable directions errors are a few millimeters at
/// most.
void slideAlongStripes(const Parameters& parameters) {
  const Camera camera = testing::smallCamera();
  const Wall wall{testing::horizontalStripes};
  Odometry odometry(camera, parameters);
  odometry.process(wall.seenFrom(camera, {0.0, 0.0}, stampOf(0)));
  for (int i = 1; i < 30; ++i) {
    const TrackingResult& result =
        odometry.process(wall.seenFrom(camera, {slidden(i), 0.0}, stampOf(i)));
    EXPECT_EQ(result.state, TrackingState::kDegraded) << i;
    EXPECT_EQ(result.reason, TrackingReason::kOpenDirections) << i;
    EXPECT_TRUE(result.open_directions[0]) << i;
    EXPECT_FALSE(result.open_directions[2]) << i;
    EXPECT_NE(describeReason(result).find("sideways"), std::string::npos) << i;
    expectHonest(result, slidden(i), i);
    const Vector6 error = errorAt(result, slidden(i));
    EXPECT_LT(std::abs(error[2]), 0.01) << i;
    EXPECT_LT(std::abs(error[3]), 0.01) << i;
  }
}

TEST(OpenDirectionsTest, AlongStripesTheMotionIsNotSeenAndItSaysSo) {
  slideAlongStripes({});
}

TEST(OpenDirectionsTest, AlongStripesTheMethodOfThePaperSaysSoToo) {
  slideAlongStripes(methodOfThePaper());
}

TEST(OpenDirectionsTest, LittleTextureOnTheStripesIsEnough) {
  const Camera camera = testing::smallCamera();
  const Wall wall{[](double x, double y) {
    // Waves of 1.5 gray levels, eight pixels long.
    return testing::stripes(y) +
           1.5 * (std::sin(52.0 * x + 8.0 * y) + std::sin(45.0 * x - 9.0 * y));
  }};
  Odometry odometry(camera, {});
  odometry.process(wall.seenFrom(camera, {0.0, 0.0}, stampOf(0)));
  for (int i = 1; i < 30; ++i) {
    const TrackingResult& result =
        odometry.process(wall.seenFrom(camera, {slidden(i), 0.0}, stampOf(i)));
    EXPECT_EQ(result.state, TrackingState::kTracking) << i;
    EXPECT_LT(errorAt(result, slidden(i)).head<3>().norm(), 0.005) << i;
    expectHonest(result, slidden(i), i);
  }
}

TEST(OpenDirectionsTest, DepthOfABlankWallLeavesItsPlaneOpen) {
  const Camera camera = testing::smallCamera();
  const Wall wall{testing::blank};
  Odometry odometry(camera, {});
  odometry.process(wall.seenFrom(camera, {0.0, 0.0}, stampOf(0)));
  ASSERT_TRUE(odometry.hasKeyframe());
  for (int i = 1; i < 15; ++i) {
    const TrackingResult& result =
        odometry.process(wall.seenFrom(camera, {slidden(i), 0.0}, stampOf(i)));
    EXPECT_EQ(result.state, TrackingState::kDegraded) << i;
    const Directions in_plane = {true, true, false, false, false, true};
    EXPECT_EQ(result.open_directions, in_plane) << i;
    EXPECT_EQ(describeReason(result),
              "motion is not observable: sideways, up and down, turning about the viewing axis")
        << i;
    expectHonest(result, slidden(i), i);
    EXPECT_LT(std::abs(errorAt(result, slidden(i))[2]), 0.01) << i;
  }
}

TEST(OpenDirectionsTest, TheCameraMayStopWhereThereIsNothingToSee) {
  const Camera camera = testing::smallCamera();
  const Wall textured{testing::texture};
  const Wall blank{testing::blank};
  constexpr int kBlankFrom = 15;
  constexpr int kTexturedFrom = 40;
  Odometry odometry(camera, {});
  for (int i = 0; i < 55; ++i) {
    const bool is_blank = i >= kBlankFrom && i < kTexturedFrom;
    const double x = slidden(std::min(i, kBlankFrom));
    const TrackingResult& result =
        odometry.process((is_blank ? blank : textured).seenFrom(camera, {x, 0.0}, stampOf(i)));
    const double error = errorAt(result, x).head<3>().norm();
    if (result.state == TrackingState::kTracking) {
      EXPECT_LT(error, 0.05) << i;
    }
    if (is_blank) {
      EXPECT_NE(result.state, TrackingState::kTracking) << i;
    }
    expectHonest(result, x, i);
  }
  EXPECT_EQ(odometry.result().state, TrackingState::kTracking);
  EXPECT_EQ(odometry.result().segment, 0);
}

}  // namespace
}  // namespace mivo
