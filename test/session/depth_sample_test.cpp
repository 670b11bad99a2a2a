// SPDX-License-Identifier: BSD-3-Clause
#include "session/depth_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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

/// A slanted floor of 1 to 4 m in millimeters, through a function of each value.
template <typename Function>
Frame floorThrough(const Function& function) {
  Frame frame;
  frame.depth.create(120, 160, CV_16UC1);
  for (int y = 0; y < frame.depth.rows; ++y) {
    for (int x = 0; x < frame.depth.cols; ++x) {
      frame.depth.at<std::uint16_t>(y, x) =
          static_cast<std::uint16_t>(function(4000 - 25 * y + x % 7));
    }
  }
  return frame;
}

TEST(ExamineDepthStorageTest, MillimetersAndOtherUnitsArePlain) {
  for (const double factor : {0.256, 1.0, 5.0, 10.0}) {
    const DepthStorage storage =
        examineDepthStorage(floorThrough([&](int depth) { return std::lround(factor * depth); }));
    EXPECT_FALSE(storage.is_multiple_of_8) << factor;
    EXPECT_FALSE(storage.is_rotated_right) << factor;
    EXPECT_EQ(storage.coarse_step, 0.0) << factor;
  }
}

TEST(ExamineDepthStorageTest, RotatedBitsAreSeen) {
  const auto left = [](int depth) { return depth << 3 | depth >> 13; };
  const DepthStorage rotated_left = examineDepthStorage(floorThrough(left));
  EXPECT_TRUE(rotated_left.is_multiple_of_8);
  EXPECT_FALSE(rotated_left.is_rotated_right);
  const auto right = [](int depth) { return depth >> 3 | depth << 13; };
  const DepthStorage rotated_right = examineDepthStorage(floorThrough(right));
  EXPECT_FALSE(rotated_right.is_multiple_of_8);
  EXPECT_TRUE(rotated_right.is_rotated_right);
}

/// 40 x 30 neighbors that are looked at, of which the first ones jump unless they are rotated.
Frame frameWithJumps(int jumps) {
  constexpr std::uint16_t kLeft = 2000 >> 3;
  constexpr std::uint16_t kRight = kLeft | 1 << 13;  // 2001, rotated to the right
  Frame frame;
  frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(kLeft));
  for (int i = 0; i < jumps; ++i) {
    frame.depth.at<std::uint16_t>(i / 40 * 8, i % 40 * 8 + 1) = kRight;
  }
  return frame;
}

TEST(ExamineDepthStorageTest, AFifthOfTheNeighborsHasToJump) {
  EXPECT_FALSE(examineDepthStorage(frameWithJumps(240)).is_rotated_right);
  EXPECT_TRUE(examineDepthStorage(frameWithJumps(241)).is_rotated_right);
}

TEST(ExamineDepthStorageTest, JumpsThatRotationDoesNotHalveAreEdges) {
  // 2.5 m beside 2 m: a jump as it is and rotated, but for those that rotation takes away.
  const auto with = [](int edges) {
    Frame frame = frameWithJumps(600);
    for (int i = 0; i < edges; ++i) {
      frame.depth.at<std::uint16_t>(i / 40 * 8, i % 40 * 8 + 1) = 2504 >> 3;
    }
    return frame;
  };
  EXPECT_TRUE(examineDepthStorage(with(299)).is_rotated_right);
  EXPECT_FALSE(examineDepthStorage(with(300)).is_rotated_right);
}

TEST(ExamineDepthStorageTest, CoarseDepthIsSeen) {
  const auto eight_levels = [](int depth) { return (depth + 624) / 625 * 625; };
  EXPECT_NEAR(examineDepthStorage(floorThrough(eight_levels)).coarse_step, 0.625, 1e-12);
  // A Kinect's steps of 2.8 mm at 1 m, growing with the square of the distance.
  const auto kinect = [](int depth) {
    return std::lround(1e6 / (std::round(357e3 / depth) / 0.357));
  };
  EXPECT_EQ(examineDepthStorage(floorThrough(kinect)).coarse_step, 0.0);
}

TEST(ExamineDepthStorageTest, FewReadingsAndMetersSayNothing) {
  const Frame empty = floorThrough([](int) { return 0; });
  EXPECT_FALSE(examineDepthStorage(empty).is_multiple_of_8);
  Frame meters = empty;
  meters.depth = cv::Mat(120, 160, CV_32FC1, cv::Scalar(2.0));
  EXPECT_FALSE(examineDepthStorage(meters).is_multiple_of_8);
}

}  // namespace
}  // namespace mivo
