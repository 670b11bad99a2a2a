// SPDX-License-Identifier: BSD-3-Clause
#include "session/gray_range.h"

#include <gtest/gtest.h>

namespace mivo {
namespace {

cv::Mat brightest(int value, int type = CV_16UC1) {
  cv::Mat image(4, 6, type, cv::Scalar::all(0));
  image.reshape(1).at<unsigned short>(2, 3) = static_cast<unsigned short>(value);
  return image;
}

TEST(GrayRangeTest, TheBrightestPixelTellsTheBits) {
  const int cases[][2] = {{0, 8},     {255, 8},   {256, 10},   {1023, 10},  {1024, 12},
                          {4095, 12}, {4096, 14}, {16383, 14}, {16384, 16}, {65535, 16}};
  for (const auto& [value, bits] : cases) {
    EXPECT_EQ(GrayRange().include(brightest(value)), bits) << value;
    EXPECT_EQ(GrayRange().include(brightest(value, CV_16UC3)), bits) << value;
  }
}

TEST(GrayRangeTest, GrowsAndStays) {
  GrayRange range;
  EXPECT_EQ(range.include(brightest(900)), 10);
  EXPECT_EQ(range.include(brightest(10)), 10);
  EXPECT_EQ(range.include(brightest(4000)), 12);
  EXPECT_EQ(range.include(brightest(900)), 12);
  EXPECT_EQ(range.include(cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(255))), 12);
}

}  // namespace
}  // namespace mivo
