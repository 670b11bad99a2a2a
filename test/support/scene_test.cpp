// SPDX-License-Identifier: BSD-3-Clause
#include "support/scene.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/projection.h"
#include "support/random_pose.h"

// Tests of the fixture: tests that use it are only as good as it is.

namespace mivo::testing {
namespace {

TEST(SceneTest, DepthOfAWallIsItsDistanceAlongTheOpticalAxis) {
  const Camera camera = smallCamera();
  const Frame frame = render(wallScene(), camera, Eigen::Isometry3d::Identity());
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(frame.depth, &low, &high);
  EXPECT_NEAR(low, 2.0, 1e-6);
  EXPECT_NEAR(high, 2.0, 1e-6);
  const Frame nearer = render(wallScene(), camera, retract(0.5 * Vector6::Unit(2)));
  EXPECT_NEAR(nearer.depth.at<float>(30, 40), 1.5, 1e-6);
}

TEST(SceneTest, APlaceOnTheWallLooksTheSameFromEverywhere) {
  const Camera camera = distortedCamera();
  Random random(5);
  const Eigen::Isometry3d T_world_a = random.pose(0.1, 0.1);
  const Eigen::Isometry3d T_world_b = random.pose(0.1, 0.1);
  const Frame a = render(wallScene(), camera, T_world_a);
  const Frame b = render(wallScene(), camera, T_world_b);
  int compared = 0;
  for (int y = 5; y < camera.height - 5; y += 7) {
    for (int x = 5; x < camera.width - 5; x += 7) {
      const double depth = static_cast<double>(a.depth.at<float>(y, x));
      const auto seen =
          testing::project(camera, T_world_b.inverse() * T_world_a * (depth * *camera.ray({x, y})));
      if (!seen || seen->x() < 1 || seen->y() < 1 || seen->x() >= camera.width - 2 ||
          seen->y() >= camera.height - 2) {
        continue;
      }
      const int u = static_cast<int>(seen->x());
      const int v = static_cast<int>(seen->y());
      // Between the darkest and the brightest of the four pixels around it, with the curvature of
      // the texture over one pixel to spare.
      double low = 255.0;
      double high = 0.0;
      cv::minMaxLoc(b.image(cv::Rect(u, v, 2, 2)), &low, &high);
      EXPECT_GE(a.image.at<unsigned char>(y, x), low - 6.0) << x << ' ' << y;
      EXPECT_LE(a.image.at<unsigned char>(y, x), high + 6.0) << x << ' ' << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(SceneTest, TheTextureUsesTheGrayLevelsAndIsSkewed) {
  const Frame frame = render(roomScene(), smallCamera(), Eigen::Isometry3d::Identity());
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(frame.image, mean, deviation);
  EXPECT_GT(deviation[0], 25.0);
  EXPECT_LT(mean[0], 120.0);
  EXPECT_EQ(cv::countNonZero(frame.depth), static_cast<int>(frame.depth.total()));
}

TEST(SceneTest, LightAndNoiseDoWhatTheySay) {
  const Camera camera = smallCamera();
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Frame plain = render(wallScene(), camera, pose);
  Light half;
  half.gain = 0.45;
  half.offset = 0.1;
  const Frame dimmed = render(wallScene(), camera, pose, half);
  const double t = (plain.image.at<unsigned char>(50, 60) / 255.0 - 0.03) / 0.9;
  EXPECT_NEAR(dimmed.image.at<unsigned char>(50, 60), 255.0 * (0.45 * t + 0.1), 1.0);
  cv::Mat difference;
  cv::subtract(withNoise(plain, 4.0, 1).image, plain.image, difference, cv::noArray(), CV_32F);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(difference, mean, deviation);
  EXPECT_NEAR(mean[0], 0.0, 0.2);
  EXPECT_NEAR(deviation[0], 4.0, 0.2);
}

TEST(SceneTest, IntegerDepthIsInMillimeters) {
  Sensor sensor;
  sensor.integer_depth = true;
  const Frame frame = render(wallScene(), smallCamera(), Eigen::Isometry3d::Identity(), {}, sensor);
  ASSERT_EQ(frame.depth.type(), CV_16UC1);
  EXPECT_EQ(frame.depth.at<unsigned short>(3, 4), 2000);
}

TEST(SceneTest, RowsOfARollingShutterAreSeenFromTheirOwnPose) {
  const Camera camera = smallCamera();
  const Vector6 twist = (Vector6() << 0.1, 0.0, 0.0, 0.0, 0.05, 0.0).finished();
  const Frame rolling = renderRolling(roomScene(), camera, Eigen::Isometry3d::Identity(), twist);
  for (const int row : {0, 60, 90}) {
    const Frame still = render(roomScene(), camera, retract((row / 120.0 - 0.5) * twist));
    EXPECT_EQ(cv::norm(rolling.image.row(row), still.image.row(row), cv::NORM_INF), 0.0) << row;
  }
}

}  // namespace
}  // namespace mivo::testing
