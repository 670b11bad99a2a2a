// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/frame.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "mivo/core/error.h"
#include "support/scene.h"

namespace mivo {
namespace {

using testing::smallCamera;

cv::Mat colorNoise(int type) {
  cv::Mat image(24, 32, type);
  cv::RNG generator(7);
  generator.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

bool isSame(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(ToGrayTest, GrayIsHandedOnWithoutACopy) {
  const cv::Mat image = colorNoise(CV_8UC1);
  EXPECT_EQ(toGray(image, ChannelOrder::kRgb).data, image.data);
}

TEST(ToGrayTest, RgbAndBgrOfTheSameSceneGiveTheSameBits) {
  const cv::Mat rgb = colorNoise(CV_8UC3);
  cv::Mat bgr;
  cv::Mat rgba;
  cv::Mat bgra;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  cv::cvtColor(rgb, rgba, cv::COLOR_RGB2RGBA);
  cv::cvtColor(rgb, bgra, cv::COLOR_RGB2BGRA);
  const cv::Mat gray = toGray(rgb, ChannelOrder::kRgb);
  ASSERT_EQ(gray.type(), CV_8UC1);
  EXPECT_TRUE(isSame(toGray(bgr, ChannelOrder::kBgr), gray));
  EXPECT_TRUE(isSame(toGray(rgba, ChannelOrder::kRgb), gray));
  EXPECT_TRUE(isSame(toGray(bgra, ChannelOrder::kBgr), gray));
  EXPECT_FALSE(isSame(toGray(bgr, ChannelOrder::kRgb), gray));
}

TEST(ToGrayTest, GreenIsTheBrightestPrimary) {
  const auto grayOf = [](int r, int g, int b) {
    const cv::Mat image(1, 1, CV_8UC3, cv::Scalar(r, g, b));
    return static_cast<int>(toGray(image, ChannelOrder::kRgb).at<unsigned char>(0, 0));
  };
  EXPECT_NEAR(grayOf(255, 0, 0), 0.299 * 255, 1.0);
  EXPECT_NEAR(grayOf(0, 255, 0), 0.587 * 255, 1.0);
  EXPECT_NEAR(grayOf(0, 0, 255), 0.114 * 255, 1.0);
  EXPECT_EQ(grayOf(90, 90, 90), 90);
}

TEST(ToGrayTest, SixteenBitsGiveTheirHighByte) {
  cv::Mat image(1, 65536, CV_16UC1);
  for (int value = 0; value < 65536; ++value) {
    image.at<unsigned short>(0, value) = static_cast<unsigned short>(value);
  }
  const cv::Mat gray = toGray(image, ChannelOrder::kRgb);
  ASSERT_EQ(gray.type(), CV_8UC1);
  int wrong = 0;
  for (int value = 0; value < 65536; ++value) {
    if (gray.at<unsigned char>(0, value) != value >> 8) ++wrong;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(ToGrayTest, FewerBitsGiveTheirHighestEight) {
  for (const int bits : {8, 10, 12, 14}) {
    const int count = 1 << bits;
    cv::Mat image(1, count, CV_16UC1);
    for (int i = 0; i < count; ++i) {
      image.at<unsigned short>(0, i) = static_cast<unsigned short>(i);
    }
    const cv::Mat gray = toGray(image, ChannelOrder::kRgb, bits);
    int wrong = 0;
    for (int i = 0; i < count; ++i) {
      if (gray.at<unsigned char>(0, i) != i >> (bits - 8)) ++wrong;
    }
    EXPECT_EQ(wrong, 0) << bits;
    const cv::Mat beyond(1, 1, CV_16UC1, cv::Scalar(65535));
    EXPECT_EQ(toGray(beyond, ChannelOrder::kRgb, bits).at<unsigned char>(0, 0), 255);
  }
}

TEST(ToGrayTest, SixteenBitColorIsThatOfEightBits) {
  cv::Mat color(1, 3, CV_8UC3);
  color.at<cv::Vec3b>(0, 0) = {250, 100, 5};
  color.at<cv::Vec3b>(0, 1) = {0, 255, 17};
  color.at<cv::Vec3b>(0, 2) = {90, 91, 92};
  cv::Mat wide;
  color.convertTo(wide, CV_16U, 257.0);
  for (const ChannelOrder order : {ChannelOrder::kRgb, ChannelOrder::kBgr}) {
    EXPECT_TRUE(isSame(toGray(wide, order), toGray(color, order)));
  }
  color.convertTo(wide, CV_16U, 4.0);
  EXPECT_TRUE(isSame(toGray(wide, ChannelOrder::kBgr, 10), toGray(color, ChannelOrder::kBgr)));
}

TEST(ToGrayTest, OtherTypesAreRefusedByName) {
  for (const int type : {CV_32FC1, CV_16UC2, CV_8UC2, CV_16SC1}) {
    try {
      toGray(cv::Mat(4, 4, type, cv::Scalar::all(1)), ChannelOrder::kRgb);
      ADD_FAILURE() << type;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(std::to_string(type)), std::string::npos);
    }
  }
}

class FindFaultTest : public ::testing::Test {
 protected:
  FindFaultTest() {
    frame_.image = cv::Mat(camera_.height, camera_.width, CV_8UC1, cv::Scalar(0));
    frame_.depth = cv::Mat(camera_.height, camera_.width, CV_16UC1, cv::Scalar(0));
  }

  void expectFault(const std::string& words) {
    const std::string fault = findFault(frame_, camera_);
    EXPECT_NE(fault.find(words), std::string::npos) << "'" << fault << "'";
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }

  Camera camera_ = smallCamera();
  Frame frame_;
};

TEST_F(FindFaultTest, AGoodFrameHasNone) {
  EXPECT_EQ(findFault(frame_, camera_), "");
  frame_.depth = cv::Mat(camera_.height, camera_.width, CV_32FC1, cv::Scalar(1));
  frame_.depth_unit = 0.0;  // not used for depth in meters
  EXPECT_EQ(findFault(frame_, camera_), "");
}

TEST_F(FindFaultTest, TheStampMustBeFinite) {
  frame_.stamp = std::numeric_limits<double>::quiet_NaN();
  expectFault("stamp");
}

TEST_F(FindFaultTest, TheImageMustBeGray) {
  frame_.image = cv::Mat(camera_.height, camera_.width, CV_8UC3, cv::Scalar(0));
  expectFault("8-bit gray");
  frame_.image = cv::Mat();
  expectFault("8-bit gray");
}

TEST_F(FindFaultTest, SizesMustAgree) {
  frame_.image = cv::Mat(60, 80, CV_8UC1, cv::Scalar(0));
  expectFault("80 x 60");
  expectFault("160 x 120");
  frame_.image = cv::Mat(camera_.height, camera_.width, CV_8UC1, cv::Scalar(0));
  frame_.depth = cv::Mat(60, 80, CV_16UC1, cv::Scalar(0));
  expectFault("depth has 80 x 60");
  expectFault("register");
}

TEST_F(FindFaultTest, DepthMustBeThereAndOfAKnownType) {
  frame_.depth = cv::Mat();
  expectFault("no depth");
  frame_.depth = cv::Mat(camera_.height, camera_.width, CV_64FC1, cv::Scalar(1));
  expectFault("16-bit integer");
}

TEST_F(FindFaultTest, TheStampMustBeATime) {
  for (const double stamp : {0.0, -1e12, 1e12}) {
    frame_.stamp = stamp;
    EXPECT_EQ(findFault(frame_, camera_), "");
  }
  for (const double stamp : {-1.1e12, 1.1e12, 1e300}) {
    frame_.stamp = stamp;
    expectFault("no time in seconds");
  }
  frame_.stamp = std::numeric_limits<double>::quiet_NaN();
  expectFault("the stamp is not finite");
}

TEST_F(FindFaultTest, TheUnitOfIntegerDepthMustMakeSense) {
  for (const double unit : {0.0, -0.001, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
    frame_.depth_unit = unit;
    expectFault("unit of the depth");
  }
}

}  // namespace
}  // namespace mivo
