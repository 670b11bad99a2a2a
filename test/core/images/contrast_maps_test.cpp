// SPDX-License-Identifier: BSD-3-Clause
#include "core/images/contrast_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "support/random_pose.h"
#include "support/scene.h"

namespace mivo {
namespace {

/// The maps of level `level` of an 8-bit image.
ContrastMaps mapsOf(const cv::Mat& image) {
  ImagePyramid pyramid;
  pyramid.build(image, 4);
  ContrastMaps maps;
  maps.build(pyramid, 2);
  return maps;
}

cv::Mat normalized(const cv::Mat& image) {
  const ContrastMaps maps = mapsOf(image);
  cv::Mat result;
  normalizeImage(image, maps.level(0), result);
  return result;
}

cv::Mat room() {
  return testing::render(testing::roomScene(), testing::smallCamera(),
                         Eigen::Isometry3d::Identity())
      .image;
}

/// gain * image + offset, for gains that hardly cause rounding.
cv::Mat relit(const cv::Mat& image, double gain, double offset) {
  cv::Mat result;
  image.convertTo(result, CV_8U, gain, offset);
  return result;
}

double meanDifference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
}

// The mean of a ramp over a window is its value in the middle, so that a ramp minus its local mean
// is 0 if the map is positioned correctly; an offset of a quarter pixel gives 0.25 of the slope.
TEST(ContrastMapsTest, TheLocalMeanOfARampIsItsValueThere) {
  constexpr double kSlope = 1.0;
  cv::Mat ramp(120, 160, CV_8UC1);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      ramp.at<unsigned char>(y, x) = static_cast<unsigned char>(40 + kSlope * x);
    }
  }
  const ContrastMaps maps = mapsOf(ramp);
  cv::Mat image;
  ramp.convertTo(image, CV_32F);
  for (int y = 24; y < 96; y += 5) {
    for (int x = 24; x < 136; x += 3) {
      const double mean_error = static_cast<double>(
          normalizedIntensity(image, maps.level(0), x, y) * localContrast(maps.level(0), x, y));
      EXPECT_NEAR(mean_error, 0.0, 0.1 * kSlope) << x << ' ' << y;
    }
  }
}

TEST(ContrastMapsTest, TheDeviationIsThatOfTheWindow) {
  // 5 x 5 pixels of the image two levels up span 16 pixels from the first to the last; for a slope
  // of 1 their values are 4 apart: the deviation of -8, -4, 0, 4, 8 is sqrt(32).
  cv::Mat ramp(120, 160, CV_8UC1);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      ramp.at<unsigned char>(y, x) = static_cast<unsigned char>(40 + x);
    }
  }
  const ContrastMaps maps = mapsOf(ramp);
  EXPECT_NEAR(localContrast(maps.level(0), 80, 60) - maps.level(0).constant, std::sqrt(32.0), 0.05);
}

TEST(ContrastMapsTest, GainAndOffsetOfTheLightDropOut) {
  const cv::Mat image = relit(room(), 0.5, 0.0);  // room for a gain
  const cv::Mat before = normalized(image);
  EXPECT_LT(meanDifference(normalized(relit(image, 1.0, 60.0)), before), 0.05);
  EXPECT_LT(meanDifference(normalized(relit(image, 2.0, 0.0)), before), 0.5);
  EXPECT_LT(meanDifference(normalized(relit(image, 1.5, 30.0)), before), 1.5);
  // The normalized image is not constant.
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(before, mean, deviation);
  EXPECT_GT(deviation[0], 30.0);
  EXPECT_NEAR(mean[0], 128.0, 15.0);
}

TEST(ContrastMapsTest, TheSameForBytesAndFloats) {
  const cv::Mat image = room();
  cv::Mat real;
  image.convertTo(real, CV_32F);
  const ContrastMaps maps = mapsOf(image);
  cv::Mat a;
  cv::Mat b;
  normalizeImage(image, maps.level(0), a);
  normalizeImage(real, maps.level(0), b);
  EXPECT_LT(cv::norm(a, b, cv::NORM_INF), 1e-3);
}

// Without texture, the constant is the noise that smoothing leaves on level 0: 6/16.
TEST(ContrastMapsTest, NoiseIsMeasured) {
  testing::Random random(1);
  for (const double noise : {2.0, 5.0, 12.0}) {
    cv::Mat image(480, 640, CV_8UC1);  // 30 rows of it are used: about 1 % accuracy
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        image.at<unsigned char>(y, x) =
            cv::saturate_cast<unsigned char>(128.0 + noise * random.normal());
      }
    }
    const auto constant = static_cast<double>(mapsOf(image).level(0).constant);
    EXPECT_NEAR(constant / 0.375, noise, 0.05 * noise + 0.25) << noise;  // steps of a quarter
  }
}

TEST(ContrastMapsTest, TheConstantFallsWithTheLightDownToAFloor) {
  const float full = mapsOf(room()).level(1).constant;
  EXPECT_NEAR(mapsOf(relit(room(), 0.25, 0.0)).level(1).constant / full, 0.25F, 0.01F);
  EXPECT_EQ(mapsOf(cv::Mat(120, 160, CV_8UC1, cv::Scalar(99))).level(1).constant, 0.2F);
}

TEST(ContrastMapsTest, AFlatImageIsMiddleGray) {
  for (const int gray : {0, 100, 255}) {
    const cv::Mat result = normalized(cv::Mat(120, 160, CV_8UC1, cv::Scalar(gray)));
    EXPECT_NEAR(cv::norm(result, cv::Mat(120, 160, CV_32FC1, cv::Scalar(128)), cv::NORM_INF), 0.0,
                1e-2);
  }
}

}  // namespace
}  // namespace mivo
