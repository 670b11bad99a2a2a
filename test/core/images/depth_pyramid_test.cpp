// SPDX-License-Identifier: BSD-3-Clause
#include "core/images/depth_pyramid.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/kernels/kernels.h"

namespace mivo {
namespace {

Frame frameOf(const cv::Mat& depth) {
  Frame frame;
  frame.depth = depth;
  return frame;
}

cv::Mat constantDepth(float meters) {
  return {12, 16, CV_32FC1, cv::Scalar(meters)};
}

constexpr double kMin = 0.3;
constexpr double kMax = 10.0;
constexpr double kRatio = 0.06;

TEST(DepthPyramidTest, IntegersAndMetersGiveTheSameDepth) {
  cv::Mat raw(12, 16, CV_16UC1, cv::Scalar(2500));
  Frame frame = frameOf(raw);
  frame.depth_unit = 0.0004;
  DepthPyramid pyramid;
  pyramid.build(frame, 1, kMin, kMax, kRatio);
  ASSERT_EQ(pyramid.level(0).type(), CV_32FC1);
  EXPECT_FLOAT_EQ(pyramid.level(0).at<float>(5, 5), 1.0F);
  pyramid.build(frameOf(constantDepth(1.0F)), 1, kMin, kMax, kRatio);
  EXPECT_FLOAT_EQ(pyramid.level(0).at<float>(5, 5), 1.0F);
}

TEST(DepthPyramidTest, WhatIsNoReadingOrOutOfTheLimitsIsAHole) {
  cv::Mat depth = constantDepth(2.0F);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const float values[] = {0.0F, nan, infinity, -infinity, -1.0F, 0.29F, 10.1F};
  for (int i = 0; i < 7; ++i) depth.at<float>(0, i) = values[i];
  depth.at<float>(0, 7) = 0.31F;
  depth.at<float>(0, 8) = 9.9F;
  DepthPyramid pyramid;
  pyramid.build(frameOf(depth), 1, kMin, kMax, kRatio);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(pyramid.level(0).at<float>(0, i), 0.0F) << values[i];
  EXPECT_EQ(pyramid.level(0).at<float>(0, 7), 0.31F);
  EXPECT_EQ(pyramid.level(0).at<float>(0, 8), 9.9F);
}

TEST(DepthPyramidTest, HolesStayHolesAndDoNotSpread) {
  cv::Mat depth = constantDepth(2.0F);
  depth.at<float>(4, 6) = 0.0F;  // pixel (3, 2) of the next level
  depth.at<float>(5, 9) = 0.0F;  // beside pixel (4, 2)
  DepthPyramid pyramid;
  pyramid.build(frameOf(depth), 2, kMin, kMax, kRatio);
  const cv::Mat& coarse = pyramid.level(1);
  ASSERT_EQ(coarse.size(), cv::Size(8, 6));
  for (int y = 0; y < coarse.rows; ++y) {
    for (int x = 0; x < coarse.cols; ++x) {
      EXPECT_FLOAT_EQ(coarse.at<float>(y, x), x == 3 && y == 2 ? 0.0F : 2.0F) << x << ' ' << y;
    }
  }
}

TEST(DepthPyramidTest, DepthIsNotAveragedAcrossAnEdge) {
  cv::Mat depth = constantDepth(1.0F);
  depth.colRange(7, 16) = 2.0F;
  DepthPyramid pyramid;
  pyramid.build(frameOf(depth), 3, kMin, kMax, kRatio);
  for (int level = 1; level < 3; ++level) {
    const cv::Mat& coarse = pyramid.level(level);
    for (int y = 0; y < coarse.rows; ++y) {
      for (int x = 0; x < coarse.cols; ++x) {
        EXPECT_EQ(coarse.at<float>(y, x), x << level < 7 ? 1.0F : 2.0F) << level << ' ' << x;
      }
    }
  }
}

TEST(DepthPyramidTest, APixelIsTheMeanOfItsSurfaceAroundTheEvenPixel) {
  cv::Mat depth = constantDepth(2.0F);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) depth.at<float>(y, x) = 2.0F + 0.01F * x + 0.02F * y;
  }
  DepthPyramid pyramid;
  pyramid.build(frameOf(depth), 2, kMin, kMax, kRatio);
  // On a plane the mean is the value in the middle: pixel (x, y) belongs to (2x, 2y).
  for (int y = 1; y < 5; ++y) {
    for (int x = 1; x < 7; ++x) {
      EXPECT_NEAR(pyramid.level(1).at<float>(y, x), depth.at<float>(2 * y, 2 * x), 1e-6);
    }
  }
}

TEST(DepthPyramidTest, OddSizesKeepTheirLastPixel) {
  DepthPyramid pyramid;
  pyramid.build(frameOf(cv::Mat(11, 13, CV_32FC1, cv::Scalar(3.0F))), 3, kMin, kMax, kRatio);
  EXPECT_EQ(pyramid.level(1).size(), cv::Size(7, 6));
  EXPECT_EQ(pyramid.level(2).size(), cv::Size(4, 3));
  EXPECT_EQ(pyramid.level(2).at<float>(2, 3), 3.0F);
}

/// Whether the reference keeps a candidate at a pixel.
bool isSmoothDepth(const cv::Mat& depth, int x, int y, float edge_ratio) {
  std::vector<std::uint8_t> candidates(static_cast<std::size_t>(depth.cols), 1);
  const float* const rows[3] = {depth.ptr<float>(y - 1), depth.ptr<float>(y),
                                depth.ptr<float>(y + 1)};
  kernels::scalar().keepSmooth(rows, depth.cols, edge_ratio, 1, candidates.data());
  return candidates[static_cast<std::size_t>(x)] != 0;
}

TEST(SmoothDepthTest, AHoleOrAnEdgeInTheNeighborhoodIsNotSmooth) {
  cv::Mat depth = constantDepth(2.0F);
  EXPECT_TRUE(isSmoothDepth(depth, 5, 5, 0.06F));
  depth.at<float>(4, 4) = 0.0F;
  EXPECT_FALSE(isSmoothDepth(depth, 5, 5, 0.06F));
  EXPECT_TRUE(isSmoothDepth(depth, 6, 5, 0.06F));
  depth.at<float>(4, 4) = 2.11F;
  EXPECT_TRUE(isSmoothDepth(depth, 5, 5, 0.06F));
  depth.at<float>(6, 6) = 1.98F;  // the span counts, not the difference from the middle
  EXPECT_FALSE(isSmoothDepth(depth, 5, 5, 0.06F));
  depth.at<float>(5, 5) = 0.0F;
  EXPECT_FALSE(isSmoothDepth(depth, 5, 5, 0.06F));
}

}  // namespace
}  // namespace mivo
