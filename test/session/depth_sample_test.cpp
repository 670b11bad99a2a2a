// SPDX-License-Identifier: BSD-3-Clause
#include "session/depth_sample.h"

#include <gtest/gtest.h>

#include <limits>

namespace mivo {
namespace {

TEST(SampleDepthTest, CoverageAndMedianOfBothTypes) {
  Frame frame;
  frame.depth = cv::Mat(64, 64, CV_16UC1, cv::Scalar(2000));
  frame.depth.colRange(0, 32) = cv::Scalar(0);
  EXPECT_EQ(0.5, sampleDepth(frame).coverage);
  EXPECT_EQ(2.0, sampleDepth(frame).median);
  frame.depth = cv::Mat(64, 64, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(0.0, sampleDepth(frame).coverage);
  EXPECT_EQ(0.0, sampleDepth(frame).median);
  frame.depth.rowRange(0, 16) = cv::Scalar(1.5);
  EXPECT_EQ(0.25, sampleDepth(frame).coverage);
  EXPECT_EQ(1.5, sampleDepth(frame).median);
}

}  // namespace
}  // namespace mivo
