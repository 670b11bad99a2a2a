// SPDX-License-Identifier: BSD-3-Clause
#include "ros/image_conversion.h"

#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "mivo/core/error.h"
#include "mivo/core/frame.h"
#include "ros/expect_error.h"

namespace mivo {
namespace {

namespace encodings = sensor_msgs::image_encodings;

constexpr int kWidth = 6;
constexpr int kHeight = 4;

sensor_msgs::Image makeMessage(const cv::Mat& image, const std::string& encoding) {
  sensor_msgs::Image message;
  message.width = static_cast<std::uint32_t>(image.cols);
  message.height = static_cast<std::uint32_t>(image.rows);
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(image.step);
  message.data.assign(image.data, image.data + image.step * static_cast<std::size_t>(image.rows));
  return message;
}

/// An image whose channels and pixels all differ.
cv::Mat pattern(int type) {
  cv::Mat image(kHeight, kWidth, type);
  std::uint8_t value = 7;
  for (int y = 0; y < kHeight; ++y) {
    for (std::size_t i = 0; i < kWidth * image.elemSize(); ++i) {
      image.ptr(y)[i] = value;
      value = static_cast<std::uint8_t>(value * 5 + 13);
    }
  }
  return image;
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(ToGrayImageTest, Mono8IsNotCopied) {
  const sensor_msgs::Image message = makeMessage(pattern(CV_8UC1), encodings::MONO8);
  EXPECT_EQ(message.data.data(), toGrayImage(message).data);
}

TEST(ToGrayImageTest, ColorEncodingsGiveTheGrayOfTheirOrder) {
  const cv::Mat three = pattern(CV_8UC3);
  const cv::Mat four = pattern(CV_8UC4);
  EXPECT_TRUE(
      equal(toGray(three, ChannelOrder::kRgb), toGrayImage(makeMessage(three, encodings::RGB8))));
  EXPECT_TRUE(
      equal(toGray(three, ChannelOrder::kBgr), toGrayImage(makeMessage(three, encodings::BGR8))));
  EXPECT_TRUE(
      equal(toGray(four, ChannelOrder::kRgb), toGrayImage(makeMessage(four, encodings::RGBA8))));
  EXPECT_TRUE(
      equal(toGray(four, ChannelOrder::kBgr), toGrayImage(makeMessage(four, encodings::BGRA8))));
  // The two orders differ, so that a mix-up cannot pass.
  EXPECT_FALSE(equal(toGray(three, ChannelOrder::kRgb), toGray(three, ChannelOrder::kBgr)));
}

TEST(ToGrayImageTest, PureRedIsDarkerThanPureGreen) {
  const cv::Mat red(kHeight, kWidth, CV_8UC3, cv::Scalar(255, 0, 0));
  EXPECT_EQ(76, toGrayImage(makeMessage(red, encodings::RGB8)).at<std::uint8_t>(0, 0));  // 0.299
  EXPECT_EQ(29, toGrayImage(makeMessage(red, encodings::BGR8)).at<std::uint8_t>(0, 0));  // 0.114
}

TEST(ToGrayImageTest, MosaicOfOneColorBecomesItsGray) {
  // A red surface: only the red cells of the mosaic are lit.
  for (const auto& [encoding, x, y] :
       {std::tuple(encodings::BAYER_RGGB8, 0, 0), std::tuple(encodings::BAYER_BGGR8, 1, 1),
        std::tuple(encodings::BAYER_GRBG8, 1, 0), std::tuple(encodings::BAYER_GBRG8, 0, 1)}) {
    cv::Mat mosaic = cv::Mat::zeros(16, 16, CV_8UC1);
    for (int v = y; v < 16; v += 2) {
      for (int u = x; u < 16; u += 2) mosaic.at<std::uint8_t>(v, u) = 200;
    }
    const cv::Mat gray = toGrayImage(makeMessage(mosaic, encoding));
    EXPECT_NEAR(0.299 * 200, gray.at<std::uint8_t>(8, 8), 1.0) << encoding;
  }
}

TEST(ToGrayImageTest, Yuv422OfGrayKeepsItsBrightness) {
  cv::Mat uyvy(kHeight, kWidth, CV_8UC2, cv::Scalar(128, 180));  // U or V, then Y
  const int gray = toGrayImage(makeMessage(uyvy, encodings::YUV422)).at<std::uint8_t>(1, 1);
  EXPECT_NEAR((180 - 16) * 255.0 / 219.0, gray, 2.0);  // video range
}

TEST(ToGrayImageTest, Mono16OfBothByteOrdersGivesTheHighByte) {
  cv::Mat image(kHeight, kWidth, CV_16UC1, cv::Scalar(0x4020));
  EXPECT_EQ(64, toGrayImage(makeMessage(image, encodings::MONO16)).at<std::uint8_t>(0, 0));
  cv::Mat swapped(kHeight, kWidth, CV_16UC1, cv::Scalar(0x2040));
  sensor_msgs::Image message = makeMessage(swapped, encodings::MONO16);
  message.is_bigendian = 1;
  EXPECT_EQ(64, toGrayImage(message).at<std::uint8_t>(0, 0));
}

TEST(ToGrayImageTest, SixteenBitsOfColorAreThoseOfEight) {
  const cv::Mat three = pattern(CV_8UC3);
  cv::Mat wide;
  three.convertTo(wide, CV_16UC3, 257.0);
  cv::Mat alpha;
  pattern(CV_8UC4).convertTo(alpha, CV_16UC4, 257.0);
  EXPECT_TRUE(
      equal(toGrayImage(makeMessage(three, "rgb8")), toGrayImage(makeMessage(wide, "rgb16"))));
  EXPECT_TRUE(
      equal(toGrayImage(makeMessage(three, "bgr8")), toGrayImage(makeMessage(wide, "bgr16"))));
  EXPECT_TRUE(equal(toGrayImage(makeMessage(pattern(CV_8UC4), "bgra8")),
                    toGrayImage(makeMessage(alpha, "bgra16"))));
  // OpenCV's own names mean OpenCV's order.
  EXPECT_TRUE(
      equal(toGrayImage(makeMessage(three, "8UC3")), toGrayImage(makeMessage(three, "bgr8"))));
  EXPECT_TRUE(equal(toGrayImage(makeMessage(pattern(CV_8UC4), "8UC4")),
                    toGrayImage(makeMessage(pattern(CV_8UC4), "bgra8"))));
}

TEST(ToGrayImageTest, MosaicsOfSixteenBitsAreThoseOfEight) {
  for (const std::string order : {"rggb", "bggr", "gbrg", "grbg"}) {
    const cv::Mat mosaic = pattern(CV_8UC1);
    cv::Mat wide;
    mosaic.convertTo(wide, CV_16UC1, 257.0);
    const cv::Mat expected = toGrayImage(makeMessage(mosaic, "bayer_" + order + "8"));
    EXPECT_LE(
        cv::norm(expected, toGrayImage(makeMessage(wide, "bayer_" + order + "16")), cv::NORM_INF),
        1.0)
        << order;
  }
}

TEST(ToGrayImageTest, YuyvOfGrayKeepsItsBrightness) {
  cv::Mat pixels(kHeight, kWidth, CV_8UC2);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      pixels.at<cv::Vec2b>(y, x) = cv::Vec2b(static_cast<std::uint8_t>(60 + 10 * x + y), 128);
    }
  }
  for (const char* encoding : {"yuyv", "yuv422_yuy2"}) {
    const cv::Mat gray = toGrayImage(makeMessage(pixels, encoding));
    for (int x = 1; x < kWidth; ++x) {  // of "video" range: 16 to 235
      EXPECT_NEAR(gray.at<std::uint8_t>(1, x), (61 + 10 * x - 16) * 255.0 / 219.0, 1.5) << encoding;
    }
  }
}

TEST(ToGrayImageTest, TwoPlanesOfGrayKeepTheirBrightness) {
  cv::Mat planes(kHeight * 3 / 2, kWidth, CV_8UC1, cv::Scalar(128));
  planes.rowRange(0, kHeight) = 100;
  const cv::Mat expected(kHeight, kWidth, CV_8UC1, cv::Scalar((100 - 16) * 255.0 / 219.0));
  for (const char* encoding : {"nv12", "nv21"}) {
    sensor_msgs::Image message = makeMessage(planes, encoding);
    EXPECT_LE(cv::norm(toGrayImage(message), expected, cv::NORM_INF), 1.0);
    message.height = kHeight;  // of the image alone
    EXPECT_LE(cv::norm(toGrayImage(message), expected, cv::NORM_INF), 1.0);
    message.data.pop_back();
    EXPECT_ERROR(toGrayImage(message), "holds 35 bytes");
  }
}

TEST(ToGrayImageTest, RowsMayBePadded) {
  const cv::Mat wide = pattern(CV_8UC3);
  const cv::Mat part = wide.colRange(0, kWidth - 2);
  sensor_msgs::Image message = makeMessage(wide, encodings::BGR8);
  message.width = kWidth - 2;  // the step stays that of the wide image
  EXPECT_TRUE(equal(toGray(part.clone(), ChannelOrder::kBgr), toGrayImage(message)));
}

TEST(ToGrayImageTest, WrongEncodingIsRefusedByName) {
  const cv::Mat depth(kHeight, kWidth, CV_16UC1, cv::Scalar(1000));
  EXPECT_ERROR(toGrayImage(makeMessage(depth, encodings::TYPE_16UC1)), "'16UC1'");
  EXPECT_ERROR(toGrayImage(makeMessage(depth, "nonsense")), "'nonsense'");
}

TEST(ToGrayImageTest, SizesThatContradictEachOtherAreRefused) {
  sensor_msgs::Image message = makeMessage(pattern(CV_8UC3), encodings::RGB8);
  message.step = 17;
  EXPECT_ERROR(toGrayImage(message), "step of 17 bytes");
  message = makeMessage(pattern(CV_8UC3), encodings::RGB8);
  message.data.pop_back();
  EXPECT_ERROR(toGrayImage(message), "holds 71 bytes");
  message = makeMessage(pattern(CV_8UC1), encodings::MONO8);
  message.height = 0;
  EXPECT_ERROR(toGrayImage(message), "empty");
}

TEST(ToDepthImageTest, IntegersAreMillimetersAndNotCopied) {
  const cv::Mat image = pattern(CV_16UC1);
  for (const char* encoding : {"16UC1", "mono16"}) {
    const sensor_msgs::Image message = makeMessage(image, encoding);
    const DepthImage depth = toDepthImage(message);
    EXPECT_TRUE(equal(image, depth.image));
    EXPECT_EQ(message.data.data(), depth.image.data);
    EXPECT_EQ(0.001, depth.unit);
  }
}

TEST(ToDepthImageTest, RowsMayBeginInTheMiddleOfAValue) {
  for (const auto& [type, encoding] :
       {std::pair(CV_16UC1, "16UC1"), std::pair(CV_32FC1, "32FC1")}) {
    const cv::Mat image = pattern(type);
    sensor_msgs::Image message = makeMessage(image, encoding);
    constexpr std::uint32_t kPadding = 3;
    const std::vector<std::uint8_t> packed = message.data;
    message.data.clear();
    for (std::uint32_t y = 0; y < message.height; ++y) {
      const auto row = packed.begin() + y * message.step;
      message.data.insert(message.data.end(), row, row + message.step);
      message.data.insert(message.data.end(), kPadding, 77);
    }
    message.step += kPadding;
    EXPECT_TRUE(equal(image, toDepthImage(message).image)) << encoding;
  }
}

TEST(ToDepthImageTest, ForeignByteOrderIsSwapped) {
  cv::Mat image(kHeight, kWidth, CV_16UC1, cv::Scalar(0xE803));  // 1000 with its bytes swapped
  sensor_msgs::Image message = makeMessage(image, "16UC1");
  message.is_bigendian = 1;
  ASSERT_EQ(CV_16UC1, toDepthImage(message).image.type());
  EXPECT_EQ(1000, toDepthImage(message).image.at<std::uint16_t>(2, 3));

  const float meters = 1.25F;
  cv::Mat floats(kHeight, kWidth, CV_32FC1);
  std::uint8_t bytes[4];
  std::memcpy(bytes, &meters, 4);
  std::reverse(bytes, bytes + 4);
  for (int i = 0; i < kWidth * kHeight; ++i) std::memcpy(floats.data + 4 * i, bytes, 4);
  message = makeMessage(floats, "32FC1");
  message.is_bigendian = 1;
  ASSERT_EQ(CV_32FC1, toDepthImage(message).image.type());
  EXPECT_EQ(1.25F, toDepthImage(message).image.at<float>(2, 3));
}

TEST(ToDepthImageTest, FloatsAreMeters) {
  cv::Mat image(kHeight, kWidth, CV_32FC1, cv::Scalar(2.5));
  EXPECT_EQ(2.5F, toDepthImage(makeMessage(image, "32FC1")).image.at<float>(0, 0));
}

TEST(ToDepthImageTest, ColorIsRefusedByName) {
  EXPECT_ERROR(toDepthImage(makeMessage(pattern(CV_8UC3), "rgb8")), "'rgb8'");
}

sensor_msgs::CompressedImage compress(const cv::Mat& image, const char* extension,
                                      const std::string& format, std::size_t header = 0) {
  sensor_msgs::CompressedImage message;
  message.format = format;
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, image, bytes);
  message.data.assign(header, 0);
  message.data.insert(message.data.end(), bytes.begin(), bytes.end());
  return message;
}

TEST(CompressedImageTest, PngGivesTheBitsOfTheRawMessage) {
  const cv::Mat bgr = pattern(CV_8UC3);
  const cv::Mat expected = toGray(bgr, ChannelOrder::kBgr);
  EXPECT_TRUE(equal(expected, toGrayImage(compress(bgr, ".png", "rgb8; png compressed bgr8"))));
  EXPECT_TRUE(equal(expected, toGrayImage(compress(bgr, ".png", "png"))));
  // Encoded as if blue came first although red did.
  EXPECT_TRUE(equal(toGray(bgr, ChannelOrder::kRgb),
                    toGrayImage(compress(bgr, ".png", "rgb8; png compressed rgb8"))));
  const cv::Mat gray = pattern(CV_8UC1);
  EXPECT_TRUE(equal(gray, toGrayImage(compress(gray, ".png", "mono8; png compressed "))));
}

TEST(CompressedImageTest, JpegIsCloseToTheOriginal) {
  const cv::Mat smooth(48, 64, CV_8UC3, cv::Scalar(40, 90, 200));
  const cv::Mat gray = toGrayImage(compress(smooth, ".jpg", "rgb8; jpeg compressed bgr8"));
  EXPECT_LE(cv::norm(gray, toGray(smooth, ChannelOrder::kBgr), cv::NORM_INF), 3.0);
}

TEST(CompressedImageTest, DepthPngWithAndWithoutHeaderIsExact) {
  const cv::Mat depth = pattern(CV_16UC1);
  EXPECT_TRUE(
      equal(depth, toDepthImage(compress(depth, ".png", "16UC1; compressedDepth", 12)).image));
  EXPECT_TRUE(equal(depth, toDepthImage(compress(depth, ".png", "16UC1; png compressed ")).image));
}

TEST(CompressedImageTest, QuantizedInverseDepthBecomesMeters) {
  cv::Mat quantized(kHeight, kWidth, CV_16UC1, cv::Scalar(600));
  quantized.at<std::uint16_t>(0, 0) = 0;
  sensor_msgs::CompressedImage message =
      compress(quantized, ".png", "32FC1; compressedDepth png", 12);
  const float a = 1010.0F;
  const float b = -405.0F;
  std::memcpy(message.data.data() + 4, &a, 4);
  std::memcpy(message.data.data() + 8, &b, 4);
  const DepthImage depth = toDepthImage(message);
  ASSERT_EQ(CV_32FC1, depth.image.type());
  EXPECT_FLOAT_EQ(1010.0F / 1005.0F, depth.image.at<float>(1, 1));
  EXPECT_TRUE(std::isnan(depth.image.at<float>(0, 0)));
}

TEST(CompressedImageTest, AMosaicInAJpegIsDemosaiced) {
  const cv::Mat mosaic = pattern(CV_8UC1);
  const cv::Mat expected = toGrayImage(makeMessage(mosaic, "bayer_rggb8"));
  const cv::Mat gray = toGrayImage(compress(mosaic, ".png", "bayer_rggb8; png compressed "));
  EXPECT_TRUE(equal(expected, gray));
  // What was demosaiced before it was compressed is not done so again.
  const cv::Mat color = pattern(CV_8UC3);
  EXPECT_TRUE(equal(toGrayImage(compress(color, ".png", "bayer_rggb8; png compressed bgr8")),
                    toGrayImage(makeMessage(color, "bgr8"))));
}

TEST(CompressedImageTest, ZerosBehindTheEndDoNotMatter) {
  for (const char* format : {".png", ".jpg"}) {
    sensor_msgs::CompressedImage message = compress(pattern(CV_8UC3), format, "bgr8; compressed");
    const cv::Mat expected = toGrayImage(message);
    message.data.resize(message.data.size() + 5000);
    EXPECT_TRUE(equal(toGrayImage(message), expected)) << format;
  }
}

/// A message of compressedDepth in RVL, written down by hand.
sensor_msgs::CompressedImage rvlMessage(int columns, int rows, const std::vector<int>& nibbles) {
  sensor_msgs::CompressedImage message;
  message.format = "16UC1; compressedDepth rvl";
  message.data.assign(12, 0);
  const auto append = [&](std::uint32_t word) {
    for (int i = 0; i < 4; ++i) message.data.push_back(static_cast<std::uint8_t>(word >> 8 * i));
  };
  append(static_cast<std::uint32_t>(columns));
  append(static_cast<std::uint32_t>(rows));
  for (std::size_t i = 0; i < nibbles.size(); i += 8) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      word = word << 4 | static_cast<std::uint32_t>(i + k < nibbles.size() ? nibbles[i + k] : 0);
    }
    append(word);
  }
  return message;
}

TEST(CompressedImageTest, RvlIsRunsOfZerosAndDifferences) {
  // 1 zero; 3 readings 5, 4, 20: +5, -1, +16, in zigzag 10, 1, 32; 2 zeros; 0 readings. Numbers of
  // more than three bits have nibbles from the lowest on: 10 = 2 + 8 * 1 is 8 + 2, 1.
  const std::vector<int> nibbles = {1, 3, 8 + 2, 1, 1, 8 + 0, 4, 2, 0};
  const DepthImage depth = toDepthImage(rvlMessage(3, 2, nibbles));
  const cv::Mat expected = (cv::Mat_<std::uint16_t>(2, 3) << 0, 5, 4, 20, 0, 0);
  EXPECT_TRUE(equal(depth.image, expected));
  EXPECT_EQ(depth.unit, 0.001);
  EXPECT_ERROR(toDepthImage(rvlMessage(3, 2, {1, 7})), "RVL is damaged");     // too long a run
  EXPECT_ERROR(toDepthImage(rvlMessage(30, 20, nibbles)), "RVL is damaged");  // too short
  EXPECT_ERROR(toDepthImage(rvlMessage(-3, 2, nibbles)), "RVL is of -3 x 2 pixels");
}

TEST(CompressedImageTest, TruncatedAndForeignDataAreRefused) {
  const cv::Mat large(64, 64, CV_8UC3, cv::Scalar(1, 2, 3));
  sensor_msgs::CompressedImage message = compress(large, ".png", "rgb8; png compressed bgr8");
  message.data.resize(message.data.size() / 2);
  EXPECT_ERROR(toGrayImage(message), "truncated");
  message = compress(large, ".jpg", "jpeg");
  message.data.resize(message.data.size() - 40);
  EXPECT_ERROR(toGrayImage(message), "truncated");
  message.data.assign(100, 0);
  EXPECT_ERROR(toGrayImage(message), "neither JPEG nor PNG");
  message.data.clear();
  EXPECT_ERROR(toGrayImage(message), "neither JPEG nor PNG");
  message.format = "16UC1; compressedDepth rvl";
  EXPECT_ERROR(toDepthImage(message), "RVL");
  EXPECT_ERROR(toDepthImage(compress(large, ".png", "16UC1; compressedDepth", 12)),
               "has not 16 bits");
}

TEST(CompressedImageTest, ADamagedSizeIsRefused) {
  sensor_msgs::CompressedImage message = compress(pattern(CV_8UC1), ".jpg", "jpeg");
  // Behind the mark: two bytes of length, one of precision, then height and width.
  const std::uint8_t frame_header[] = {0xff, 0xc0};
  const auto at = std::search(message.data.begin(), message.data.end(), std::begin(frame_header),
                              std::end(frame_header));
  ASSERT_LT(9, message.data.end() - at);
  std::fill(at + 5, at + 9, std::uint8_t{0xfe});  // more pixels than are read
  EXPECT_ERROR(toGrayImage(message), "is of 65278 x 65278 pixels");
}

}  // namespace
}  // namespace mivo
