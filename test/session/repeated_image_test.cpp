// SPDX-License-Identifier: BSD-3-Clause
#include "session/repeated_image.h"

#include <gtest/gtest.h>

namespace mivo {
namespace {

Frame makeFrame(int gray, int depth) {
  Frame frame;
  frame.image = cv::Mat(6, 8, CV_8UC1, cv::Scalar(gray));
  frame.image.at<unsigned char>(2, 3) = 77;
  frame.depth = cv::Mat(6, 8, CV_16UC1, cv::Scalar(depth));
  return frame;
}

TEST(RepeatedImageTest, SameColorWithOtherDepthIsOne) {
  RepeatedImage repeated;
  EXPECT_FALSE(repeated.check(makeFrame(10, 1000)));
  EXPECT_FALSE(repeated.check(makeFrame(11, 1001)));
  EXPECT_TRUE(repeated.check(makeFrame(11, 1002)));
  EXPECT_TRUE(repeated.check(makeFrame(11, 1003)));
  EXPECT_FALSE(repeated.check(makeFrame(12, 1003)));
}

TEST(RepeatedImageTest, MemoryThatIsUsedAgainIsNoRepetition) {
  RepeatedImage repeated;
  Frame frame = makeFrame(10, 1000);
  EXPECT_FALSE(repeated.check(frame));
  frame.image.at<unsigned char>(0, 0) = 11;
  frame.depth.at<unsigned short>(0, 0) = 1001;
  EXPECT_FALSE(repeated.check(frame));
}

TEST(RepeatedImageTest, ARestingCameraAndACoveredLensAreNone) {
  RepeatedImage repeated;
  EXPECT_FALSE(repeated.check(makeFrame(10, 1000)));
  EXPECT_FALSE(repeated.check(makeFrame(10, 1000)));  // no noise, no motion
  Frame dark = makeFrame(0, 1000);
  dark.image = cv::Scalar(0);
  EXPECT_FALSE(repeated.check(dark));
  dark.depth = cv::Scalar(1001);
  EXPECT_FALSE(repeated.check(dark));
}

}  // namespace
}  // namespace mivo
