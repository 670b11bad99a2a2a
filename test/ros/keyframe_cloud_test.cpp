// SPDX-License-Identifier: BSD-3-Clause
#include "ros/keyframe_cloud.h"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cstdint>
#include <vector>

namespace mivo {
namespace {

using Bytes = std::vector<int>;

/// Blue, green and red of the only point, which is that of the pixel in column 2 of row 1.
Bytes colorIn(const cv::Mat& image, ChannelOrder order = ChannelOrder::kBgr) {
  const CloudPoint point = {0.1F, 0.2F, 1.5F, 77.0F, 2, 1};
  const sensor_msgs::PointCloud2Ptr cloud =
      toCloud({point}, Eigen::Isometry3d::Identity(), {image, order});
  const sensor_msgs::PointCloud2ConstIterator<std::uint8_t> rgb(*cloud, "rgb");
  return {rgb[0], rgb[1], rgb[2]};
}

cv::Mat imageOf(int type, const cv::Scalar& at_point) {
  cv::Mat image(2, 4, type, cv::Scalar::all(5));
  image(cv::Rect(2, 1, 1, 1)).setTo(at_point);
  return image;
}

TEST(KeyframeCloudTest, PointsHaveTheColorsOfTheirPixels) {
  const cv::Scalar color(10, 20, 30, 255);
  EXPECT_EQ(colorIn(imageOf(CV_8UC3, color)), (Bytes{10, 20, 30}));
  EXPECT_EQ(colorIn(imageOf(CV_8UC4, color)), (Bytes{10, 20, 30}));
  EXPECT_EQ(colorIn(imageOf(CV_8UC3, color), ChannelOrder::kRgb), (Bytes{30, 20, 10}));
}

TEST(KeyframeCloudTest, WithoutColorsOfEightBitsTheyAreGray) {
  const Bytes gray = {77, 77, 77};
  EXPECT_EQ(colorIn(imageOf(CV_8UC1, 10)), gray);
  EXPECT_EQ(colorIn(imageOf(CV_16UC3, cv::Scalar::all(500))), gray);
  EXPECT_EQ(colorIn(cv::Mat()), gray);
  EXPECT_EQ(colorIn(cv::Mat(1, 1, CV_8UC3)), gray);  // smaller than the keyframe
}

TEST(KeyframeCloudTest, PointsAreMoved) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(1.0, -2.0, 3.0);
  const sensor_msgs::PointCloud2Ptr cloud =
      toCloud({{0.1F, 0.2F, 1.5F, 77.0F, 0, 0}, {0.0F, 0.0F, 1.0F, 3.0F, 1, 0}}, T, {});
  ASSERT_EQ(cloud->width, 2U);
  const sensor_msgs::PointCloud2ConstIterator<float> x(*cloud, "x");
  EXPECT_FLOAT_EQ(x[0], 1.1F);
  EXPECT_FLOAT_EQ(x[1], -1.8F);
  EXPECT_FLOAT_EQ(x[2], 4.5F);
}

}  // namespace
}  // namespace mivo
