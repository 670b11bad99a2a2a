// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/warp.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "support/analytic_points.h"
#include "support/projection.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::analyticCamera;
using testing::Random;

Camera lensCamera() {
  Camera camera = analyticCamera();
  camera.distortion = {0.2, -0.35, 0.001, -0.002, 0.1};
  return camera;
}

const Eigen::Vector2d kSlope(1.7, -0.9);

// Bilinear interpolation of a ramp is exact, so its values give the warped pixel.
class WarpTest : public ::testing::Test {
 protected:
  void sample(const Camera& camera, const Eigen::Isometry3d& T_live_ref,
              const RowMotion& rows = {}) {
    const cv::Mat image =
        testing::rasterized(testing::rampImage(90.0, kSlope), camera.width, camera.height);
    points_ = testing::analyticPoints(testing::waves(), camera, 3);
    Warp(camera, rows, 1).sample(points_, points_.size(), T_live_ref, image, samples_);
  }

  static double ramp(const Eigen::Vector2d& pixel) { return 90.0 + kSlope.dot(pixel); }

  static bool isInside(const Eigen::Vector2d& p, const Camera& camera, double margin) {
    return p.x() >= -margin && p.y() >= -margin && p.x() < camera.width - 1 + margin &&
           p.y() < camera.height - 1 + margin;
  }

  ReferencePoints points_;
  LiveSamples samples_;
};

TEST_F(WarpTest, SamplesAreTheImageWhereThePointsProject) {
  Random random(1);
  for (const Camera& camera : {analyticCamera(), lensCamera()}) {
    for (int trial = 0; trial < 6; ++trial) {
      const Eigen::Isometry3d T = random.pose(0.15, 0.15);
      sample(camera, T);
      std::size_t seen = 0;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        const auto pixel = testing::project(camera, T * testing::pointAt(points_, i));
        if (!pixel || !isInside(*pixel, camera, 0.0)) {
          if (!pixel || !isInside(*pixel, camera, 1e-3)) {
            EXPECT_EQ(samples_.visible[i], 0.0F);
            EXPECT_EQ(samples_.value[i], 0.0F);
          }
          continue;
        }
        if (!isInside(*pixel, camera, -1e-3)) continue;  // visibility depends on rounding
        ++seen;
        ASSERT_EQ(samples_.visible[i], 1.0F);
        EXPECT_NEAR(samples_.value[i], ramp(*pixel), 2e-3);
        EXPECT_NEAR(samples_.u[i], pixel->x(), 1e-3);
        EXPECT_NEAR(samples_.v[i], pixel->y(), 1e-3);
      }
      EXPECT_GE(samples_.num_visible, seen);
      EXPECT_LE(samples_.num_visible, seen + 3);
      EXPECT_GT(seen, points_.size() / 3);
    }
  }
}

TEST_F(WarpTest, PointsBehindTheCameraAreInvisible) {
  const Eigen::Isometry3d turned = retract((Vector6() << 0, 0, 0, 0, 3.14159, 0).finished());
  for (const Camera& camera : {analyticCamera(), lensCamera()}) {
    sample(camera, turned);
    EXPECT_EQ(samples_.num_visible, 0U);
    sample(camera, retract(-10.0 * Vector6::Unit(2)));
    EXPECT_EQ(samples_.num_visible, 0U);
  }
}

TEST_F(WarpTest, PointsBesideTheImageAreInvisible) {
  sample(analyticCamera(), retract(20.0 * Vector6::Unit(0)));
  EXPECT_EQ(samples_.num_visible, 0U);
  for (const float value : samples_.value) EXPECT_EQ(value, 0.0F);
}

TEST_F(WarpTest, APoseThatIsNotFiniteSeesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Camera& camera : {analyticCamera(), lensCamera()}) {
    for (const double broken : {nan, infinity, 1e300}) {
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.translation().x() = broken;
      sample(camera, T);
      EXPECT_EQ(samples_.num_visible, 0U) << broken;
      T.translation().x() = 0.0;
      T.linear()(2, 2) = broken == infinity ? -infinity : nan;
      sample(camera, T);
      EXPECT_EQ(samples_.num_visible, 0U);
    }
  }
}

// With a rolling shutter, the point moves until its row is read.
TEST_F(WarpTest, RowsAreReadAtTheirTime) {
  RowMotion rows;
  rows.readout = 1.0;
  rows.twist << 0.02, -0.01, 0.03, 0.01, 0.04, -0.02;
  Random random(2);
  for (const Camera& camera : {analyticCamera(), lensCamera()}) {
    const Eigen::Isometry3d T = random.pose(0.05, 0.05);
    sample(camera, T, rows);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (samples_.visible[i] == 0.0F) continue;
      const Eigen::Vector3d q = T * testing::pointAt(points_, i);
      const auto first = testing::project(camera, q);
      if (!first) continue;
      const double tau = first->y() / camera.height - 0.5;
      const Eigen::Vector3d moved =
          q + tau * (rows.twist.tail<3>().cross(q) + rows.twist.head<3>());
      EXPECT_NEAR(samples_.value[i], ramp(*testing::project(camera, moved)), 3e-3);
      ++compared;
    }
    EXPECT_GT(compared, points_.size() / 2);
  }
}

TEST_F(WarpTest, NormalizedSamplesAreOffsetAndGain) {
  const Camera camera = analyticCamera();
  points_ = testing::analyticPoints(testing::waves(), camera, 3);
  const cv::Mat image =
      testing::rasterized(testing::rampImage(90.0, kSlope), camera.width, camera.height);
  // A map whose pixel (u, v) lies at (4u, 4v): ramps, so that its interpolation is exact too.
  ContrastMap map;
  const cv::Mat values[] = {
      testing::rasterized(testing::rampImage(50.0, {0.4, 0.2}), 26, 21, 4.0),
      testing::rasterized(testing::rampImage(20.0, {0.1, -0.05}), 26, 21, 4.0)};
  cv::merge(values, 2, map.pairs);
  map.constant = 3.0F;
  const Eigen::Isometry3d T = Random(3).pose(0.05, 0.05);
  Warp(camera, {}, 1).sampleNormalized(points_, points_.size(), T, image, map, 256.0, samples_);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (samples_.visible[i] == 0.0F || samples_.u[i] > 95.0F || samples_.v[i] > 75.0F) continue;
    const Eigen::Vector2d p(static_cast<double>(samples_.u[i]), static_cast<double>(samples_.v[i]));
    const double expected =
        (ramp(p) - 50.0 - 0.4 * p.x() - 0.2 * p.y()) / (23.0 + 0.1 * p.x() - 0.05 * p.y());
    EXPECT_NEAR(samples_.value[i], expected, 1e-4);
  }
}

TEST_F(WarpTest, WhatMayBeClippedIsInViewButNotVisible) {
  const Camera camera = testing::analyticCamera();
  points_ = testing::analyticPoints(testing::waves(), camera, 3);
  // Gray 90 at the left end, 2 more in each column: 250 from column 80 on.
  const cv::Mat image =
      testing::rasterized(testing::rampImage(90.0, {2.0, 0.0}), camera.width, camera.height);
  ContrastMap map;
  map.pairs = cv::Mat(camera.height / 4 + 2, camera.width / 4 + 2, CV_32FC2, cv::Scalar(100, 10));
  map.constant = 1.0F;
  Warp(camera, {}, 1)
      .sampleNormalized(points_, points_.size(), Eigen::Isometry3d::Identity(), image, map, 250.0,
                        samples_);
  std::size_t visible = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const int column = points_.pixels[i].x;
    if (column == 80) continue;  // visibility depends on rounding
    EXPECT_EQ(samples_.visible[i], column < 80 ? 1.0F : 0.0F) << column;
  }
  for (const float seen : samples_.visible) visible += seen != 0.0F ? 1U : 0U;
  EXPECT_EQ(samples_.num_visible, visible);
  EXPECT_GT(samples_.num_in_view, visible);
}

TEST_F(WarpTest, TheNumberOfThreadsDoesNotChangeABit) {
  const Camera camera = lensCamera();
  const cv::Mat image = testing::rasterized(testing::blobs(), camera.width, camera.height);
  points_ = testing::analyticPoints(testing::waves(), camera, 1);
  ASSERT_GT(points_.size(), 2U * 2048U);  // several chunks
  const Eigen::Isometry3d T = Random(4).pose(0.1, 0.1);
  Warp(camera, {}, 1).sample(points_, points_.size(), T, image, samples_);
  LiveSamples threaded;
  Warp(camera, {}, 4).sample(points_, points_.size(), T, image, threaded);
  EXPECT_EQ(samples_.value, threaded.value);
  EXPECT_EQ(samples_.visible, threaded.visible);
  EXPECT_EQ(samples_.num_visible, threaded.num_visible);
}

TEST_F(WarpTest, NoPointsAreNoSamples) {
  const Camera camera = analyticCamera();
  const cv::Mat image(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
  Warp(camera, {}, 1).sample({}, 0, Eigen::Isometry3d::Identity(), image, samples_);
  EXPECT_EQ(samples_.num_visible, 0U);
  EXPECT_TRUE(samples_.value.empty());
}

}  // namespace
}  // namespace mivo
