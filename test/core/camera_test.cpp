// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/camera.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/images/image_pyramid.h"
#include "mivo/core/error.h"
#include "support/analytic_image.h"
#include "support/numeric_derivative.h"
#include "support/projection.h"
#include "support/random_pose.h"
#include "support/scene.h"

namespace mivo {
namespace {

using testing::distortedCamera;
using testing::Random;
using testing::smallCamera;

TEST(CameraTest, ProjectionWithoutDistortionIsThePinhole) {
  const Camera camera = smallCamera();
  const auto pixel = testing::project(camera, {0.3, -0.2, 1.5});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), camera.fx * 0.2 + camera.cx, 1e-12);
  EXPECT_NEAR(pixel->y(), camera.cy - camera.fy * 0.2 / 1.5, 1e-12);
}

TEST(CameraTest, RayAndProjectionUndoEachOther) {
  for (const Camera& camera : {smallCamera(), distortedCamera()}) {
    for (double y = -0.5; y < camera.height; y += 7.3) {
      for (double x = -0.5; x < camera.width; x += 7.3) {
        const Eigen::Vector3d ray = *camera.ray({x, y});
        EXPECT_EQ(ray.z(), 1.0);
        for (const double depth : {0.3, 4.0}) {
          const auto pixel = testing::project(camera, depth * ray);
          ASSERT_TRUE(pixel) << x << ' ' << y;
          EXPECT_NEAR((*pixel - Eigen::Vector2d(x, y)).norm(), 0.0, 1e-9);
        }
      }
    }
  }
}

// OpenCV's distortion model, written independently, with a different value for each coefficient.
TEST(CameraTest, DistortionIsThePlumbBobModel) {
  const Distortion d{0.21, -0.33, 0.0015, -0.0024, 0.12};
  Camera camera = smallCamera();
  camera.distortion = d;
  const double x = 0.31;
  const double y = -0.24;
  const double r2 = x * x + y * y;
  const double radial = 1 + d.k1 * r2 + d.k2 * r2 * r2 + d.k3 * r2 * r2 * r2;
  const Eigen::Vector2d expected(x * radial + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x),
                                 y * radial + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y);
  EXPECT_LT((camera.distort({x, y}) - expected).norm(), 1e-15);
}

TEST(CameraTest, DerivativeOfTheDistortionAgreesWithDifferences) {
  const Camera camera = distortedCamera();
  for (const Eigen::Vector2d& place :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.5, -0.3), Eigen::Vector2d(-0.2, 0.4)}) {
    Eigen::Matrix2d derivative;
    camera.distort(place, &derivative);
    const auto function = [&](const Eigen::Vector2d& p) { return camera.distort(p); };
    EXPECT_TRUE(testing::convergesTo(
        derivative,
        [&](double step) { return testing::numericJacobian<2, 2>(function, place, step); }, 0.02,
        1e-10));
  }
}

TEST(CameraTest, PointsBehindTheCameraHaveNoPixel) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Camera& camera : {smallCamera(), distortedCamera()}) {
    EXPECT_FALSE(testing::project(camera, {0.1, 0.1, 0.0}));
    EXPECT_FALSE(testing::project(camera, {0.1, 0.1, -1.0}));
    EXPECT_FALSE(testing::project(camera, {0.1, 0.1, nan}));
  }
}

// A barrel lens: far outside the image the polynomial decreases again and would project points from
// the side into the middle of the image.
TEST(CameraTest, WhereThePolynomialFoldsBackThereIsNoPixel) {
  Camera camera = smallCamera();
  camera.distortion.k1 = -0.3;
  // r (1 - 0.3 r^2) has its maximum at r = 1 / sqrt(0.9); at r = 1.8 it is back at 0.05.
  ASSERT_LT(camera.distort({1.8, 0.0}).x(), 0.06);
  EXPECT_FALSE(testing::project(camera, {1.8, 0.0, 1.0}));
  EXPECT_TRUE(testing::project(camera, {0.6, 0.4, 1.0}));
  EXPECT_LT(camera.lensRange().undistorted, std::sqrt(1.0 / 0.9));
}

TEST(CameraTest, EveryPixelIsWithinTheRadiusOfTheDistortion) {
  for (double k1 : {-0.2, -0.1, 0.3}) {
    Camera camera = smallCamera();
    camera.distortion.k1 = k1;
    for (const Eigen::Vector2d& corner :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(camera.width - 1, 0),
          Eigen::Vector2d(0, camera.height - 1),
          Eigen::Vector2d(camera.width - 1, camera.height - 1)}) {
      const auto ray = camera.ray(corner);
      ASSERT_TRUE(ray) << k1;
      EXPECT_LT(ray->head<2>().norm(), camera.lensRange().undistorted) << k1;
    }
  }
}

// Largest difference, in pixels of the level, between a pyramid level of a ramp over normalized
// coordinates and the ramp as the level's camera projects it. The border is left out, because the
// Gaussian mirrors the image there.
double largestShift(const Camera& fine, const Camera& coarse, int level) {
  const double slope = 120.0;
  const auto scene = [=](const Camera& camera, int x, int y) {
    return 100.0 + slope * (x - camera.cx) / camera.fx + 0.5 * slope * (y - camera.cy) / camera.fy;
  };
  cv::Mat image(fine.height, fine.width, CV_32FC1);
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      image.at<float>(y, x) = static_cast<float>(scene(fine, x, y));
    }
  }
  for (int l = 0; l < level; ++l) cv::pyrDown(cv::Mat(image), image);
  EXPECT_EQ(image.cols, coarse.width);
  EXPECT_EQ(image.rows, coarse.height);
  double largest = 0.0;
  for (int y = 3; y < image.rows - 3; ++y) {
    for (int x = 3; x < image.cols - 3; ++x) {
      const double error = static_cast<double>(image.at<float>(y, x)) - scene(coarse, x, y);
      largest = std::max(largest, std::abs(error) * coarse.fx / slope);
    }
  }
  return largest;
}

constexpr double kPixelTolerance = 0.01;  // a wrong rule shifts a level by a quarter pixel or more

TEST(CameraTest, EachLevelOfTheImageAgreesWithTheCameraOfThatLevel) {
  Camera odd = smallCamera();
  odd.width = 163;
  odd.height = 121;
  for (const Camera& camera : {smallCamera(), odd}) {
    for (int level = 0; level <= 3; ++level) {
      EXPECT_LT(largestShift(camera, camera.atLevel(level), level), kPixelTolerance) << level;
    }
  }
}

TEST(CameraTest, TheHalfPixelRuleOfABoxFilterWouldBeCaught) {
  const Camera camera = smallCamera();
  Camera wrong = camera.atLevel(1);
  wrong.cx = (camera.cx + 0.5) / 2.0 - 0.5;
  wrong.cy = (camera.cy + 0.5) / 2.0 - 0.5;
  EXPECT_GT(largestShift(camera, wrong, 1), 10.0 * kPixelTolerance);
}

TEST(CameraTest, ALevelIsHalfOfTheFinerOneAndKeepsTheDistortion) {
  const Camera camera = distortedCamera();
  EXPECT_EQ(camera.atLevel(0), camera);
  EXPECT_EQ(camera.atLevel(3), camera.atLevel(1).atLevel(2));
  EXPECT_EQ(camera.atLevel(2).distortion.k2, camera.distortion.k2);
  EXPECT_NE(camera.atLevel(1), camera);
  for (const int level : {1, 2}) {
    const Eigen::Vector3d point(0.2, 0.1, 1.3);
    const double scale = 1 << level;
    const auto pixel = testing::project(camera.atLevel(level), point);
    EXPECT_LT((scale * *pixel - *testing::project(camera, point)).norm(), 1e-9);
  }
}

TEST(CameraTest, ValidateNamesWhatIsWrong) {
  EXPECT_NO_THROW(distortedCamera().validate());
  const auto isRefused = [](const auto& change) {
    Camera camera = smallCamera();
    change(camera);
    try {
      camera.validate();
    } catch (const Error& error) {
      return std::string(error.what()).find("must be positive") != std::string::npos;
    }
    return false;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(isRefused([](Camera& c) { c.width = 0; }));
  EXPECT_TRUE(isRefused([](Camera& c) { c.height = -5; }));
  EXPECT_TRUE(isRefused([](Camera& c) { c.fx = 0.0; }));
  EXPECT_TRUE(isRefused([](Camera& c) { c.fy = -100.0; }));
  EXPECT_TRUE(isRefused([=](Camera& c) { c.cx = nan; }));
  EXPECT_TRUE(isRefused([=](Camera& c) { c.distortion.k3 = nan; }));
  EXPECT_TRUE(isRefused([](Camera& c) { c.cy = std::numeric_limits<double>::infinity(); }));
}

TEST(ImagePyramidTest, LevelsHalveAndTheCoarsestKeepsASensibleSize) {
  EXPECT_EQ(usableLevels(640, 480, 5), 5);
  EXPECT_EQ(usableLevels(640, 480, 3), 3);
  EXPECT_EQ(usableLevels(20, 20, 8), 1);
  for (int wanted = 1; wanted <= 8; ++wanted) {
    const Camera coarsest = smallCamera().atLevel(usableLevels(160, 120, wanted) - 1);
    EXPECT_GE(std::min(coarsest.width, coarsest.height), 15);
  }
}

TEST(ImagePyramidTest, LevelZeroIsTheImageAndBuffersCanBeReused) {
  const cv::Mat large(60, 80, CV_8UC1, cv::Scalar(40));
  cv::Mat small(30, 40, CV_8UC1, cv::Scalar(0));
  small.at<unsigned char>(7, 9) = 200;
  ImagePyramid pyramid;
  pyramid.build(large, 3);
  pyramid.build(small, 2);
  EXPECT_EQ(pyramid.numLevels(), 2);
  ASSERT_EQ(pyramid.level(0).type(), CV_8UC1);
  EXPECT_EQ(pyramid.level(0).at<unsigned char>(7, 9), 200);
  ASSERT_EQ(pyramid.level(1).type(), CV_32FC1);
  EXPECT_EQ(pyramid.level(1).size(), cv::Size(20, 15));
}

}  // namespace
}  // namespace mivo
