// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <sstream>

#include "ros/small_bag.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

/// Boxes in front of a wall, each with a gray level of its own; depth moved by (dx, dy) pixels.
Frame boxes(int dx, int dy, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  Frame frame;
  frame.image = cv::Mat(240, 320, CV_8UC1, cv::Scalar(120));
  frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(3000));
  for (int i = 0; i < 12; ++i) {
    const int height = uniform(20, 40);
    const int width = uniform(20, 50);
    const int top = uniform(30, 170);
    const int left = uniform(30, 230);
    const cv::Rect box(left, top, width, height);
    const int depth = uniform(1000, 2000);
    cv::rectangle(frame.image, box, cv::Scalar(uniform(0, 255)), cv::FILLED);
    cv::rectangle(frame.depth, box + cv::Point(dx, dy), cv::Scalar(depth), cv::FILLED);
  }
  return frame;
}

TEST(EdgeOffsetTest, IsWhatDepthWasMovedBy) {
  for (const cv::Point& moved : {cv::Point(0, 0), cv::Point(4, -3), cv::Point(-12, 7)}) {
    EdgeOffset offset;
    for (unsigned seed = 0; seed < 10; ++seed) offset.add(boxes(moved.x, moved.y, seed));
    const auto shift = offset.shift();
    ASSERT_TRUE(shift) << moved.x;
    EXPECT_NEAR(shift->x, -moved.x, 0.3);
    EXPECT_NEAR(shift->y, -moved.y, 0.3);
  }
}

TEST(EdgeOffsetTest, IsNotToldOfAWall) {
  EdgeOffset offset;
  Frame frame;
  frame.image = cv::Mat(240, 320, CV_8UC1);
  cv::randu(frame.image, 0, 255);
  frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(2000));
  for (int i = 0; i < 10; ++i) offset.add(frame);
  EXPECT_FALSE(offset.shift());
}

TEST(FrameLookTest, TellsBrightnessSharpnessAndDepth) {
  Frame frame = boxes(0, 0, 1);
  frame.depth(cv::Rect(0, 0, 320, 120)) = 0;
  const FrameLook sharp = lookAt(frame);
  EXPECT_NEAR(sharp.depth_coverage, 0.5, 1e-9);
  EXPECT_EQ(sharp.median_depth, 3.0);
  EXPECT_DOUBLE_EQ(sharp.brightness, cv::mean(frame.image)[0]);
  cv::GaussianBlur(frame.image, frame.image, {}, 3.0);
  EXPECT_LT(lookAt(frame).sharpness, 0.4 * sharp.sharpness);
}

class BagCheckTest : public ::testing::Test {
 protected:
  std::vector<std::string> warningsOf(const SmallBag::Change& change) {
    const std::string path = folder_ / "test.bag";
    SmallBag::write(path, 0, 40, [&](int i, SmallBag::Messages& m) {
      std::fill(m.color.data.begin(), m.color.data.end(), std::uint8_t{100});
      for (std::size_t k = 0; k < m.color.data.size(); k += 7) m.color.data[k] = 140;
      change(i, m);
    });
    return checkBag({path}, {}).warnings;
  }
  static bool has(const std::vector<std::string>& warnings, const std::string& text) {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
      return warning.find(text) != std::string::npos;
    });
  }
  TemporaryFolder folder_;
};

TEST_F(BagCheckTest, NothingIsSaidOfAGoodRecording) {
  EXPECT_EQ(warningsOf([](int, SmallBag::Messages&) {}), std::vector<std::string>{});
}

TEST_F(BagCheckTest, WhatIsWrongIsSaid) {
  const auto gap = warningsOf([](int i, SmallBag::Messages& m) {
    if (i > 10 && i < 20) m.depth.data.clear();
  });
  EXPECT_TRUE(has(gap, "/camera/depth_registered/image_raw: 1 gaps, the longest 0.333 s"));
  EXPECT_TRUE(has(gap, "9 left out: color image without a partner"));

  EXPECT_TRUE(has(warningsOf([](int i, SmallBag::Messages& m) {
                    const auto jump = static_cast<std::uint8_t>(i < 20 ? 100 : 180);
                    std::fill(m.color.data.begin(), m.color.data.end(), jump);
                  }),
                  "the exposure jumps 1 times"));
  EXPECT_TRUE(has(warningsOf([](int, SmallBag::Messages& m) {
                    std::fill(m.depth.data.begin(), m.depth.data.end() - 200, std::uint8_t{0});
                  }),
                  "of the pixels have depth"));
  EXPECT_TRUE(has(warningsOf([](int i, SmallBag::Messages& m) {
                    m.recorded = toTime(SmallBag::stamp(i) + 5000.0);
                  }),
                  "stamps are 5000 s older than the clock of the recording"));
  EXPECT_TRUE(has(warningsOf([](int i, SmallBag::Messages& m) { m.info.K[0] = i < 20 ? 30 : 31; }),
                  "2 calibrations"));
  EXPECT_TRUE(has(warningsOf([](int i, SmallBag::Messages& m) {
                    m.depth.header.stamp = toTime(SmallBag::stamp(i) + 0.2);
                  }),
                  "color and depth that came together are stamped 0.200 s apart"));
}

TEST_F(BagCheckTest, DepthThatIsStampedLaterHasAPositiveOffset) {
  for (const double late : {0.008, -0.008, 0.2, -0.2}) {
    const std::string path = folder_ / "test.bag";
    SmallBag::write(path, 0, 40, [&](int i, SmallBag::Messages& m) {
      m.depth.header.stamp = toTime(SmallBag::stamp(i) + late);
    });
    const BagReport report = checkBag({path}, {});
    ASSERT_TRUE(report.clock_offset) << late;
    EXPECT_NEAR(*report.clock_offset, late, 1e-6);
    // Of images that are 33 ms apart, those nearest to each other are paired.
    if (std::abs(late) < 0.02) {
      EXPECT_NEAR(report.pair_offset, late, 1e-6);
    }
  }
}

TEST_F(BagCheckTest, ColorThatIsMirroredAgainstDepthIsSaid) {
  const auto warnings = [&](bool is_mirrored) {
    return warningsOf([&](int i, SmallBag::Messages& m) {
      const Frame frame = boxes(0, 0, static_cast<unsigned>(i));
      cv::Mat image;
      cv::flip(frame.image, image, 1);
      if (!is_mirrored) image = frame.image;
      for (sensor_msgs::Image* message : {&m.color, &m.depth}) {
        const cv::Mat& pixels = message == &m.color ? image : frame.depth;
        message->width = 320;
        message->height = 240;
        message->step = static_cast<std::uint32_t>(pixels.step);
        message->data.assign(pixels.datastart, pixels.dataend);
      }
      m.info.width = 320;
      m.info.height = 240;
      m.info.K = {300.0, 0.0, 159.5, 0.0, 300.0, 119.5, 0.0, 0.0, 1.0};
    });
  };
  const std::string text = "where those of color would be if it were mirrored";
  EXPECT_TRUE(has(warnings(true), text));
  EXPECT_FALSE(has(warnings(false), text));
}

TEST_F(BagCheckTest, AReportHasALineForEachFigureAndARowForEachFrame) {
  const std::string path = folder_ / "test.bag";
  SmallBag::write(path, 0, 12);
  const BagReport report = checkBag({path}, {});
  std::ostringstream text;
  print(text, report);
  EXPECT_NE(text.str().find("layout: openni2\n"), std::string::npos);
  EXPECT_NE(text.str().find("color: /camera/rgb/image_raw, 12 messages, 30.00 Hz"),
            std::string::npos)
      << text.str();
  const std::string csv = toCsv(report);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
}

}  // namespace
}  // namespace mivo
