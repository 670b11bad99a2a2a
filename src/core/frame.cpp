// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/frame.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// s, 30000 years: squares of times between frames stay far from overflow.
constexpr double kMaxStamp = 1e12;

std::string sizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

/// The 8 highest of the bits of 16 that are used; larger values are white.
cv::Mat highBits(const cv::Mat& image, int bits) {
  const double step = std::ldexp(1.0, bits - 8);
  cv::Mat high;
  // Rounding after this shift is the same as dropping the low bits.
  image.convertTo(high, CV_8U, 1.0 / step, 0.5 / step - 0.5);
  return high;
}

}  // namespace

cv::Mat toGray(const cv::Mat& image, ChannelOrder order, int bits) {
  const bool rgb = order == ChannelOrder::kRgb;
  cv::Mat gray;
  switch (image.type()) {
    case CV_8UC1:
      return image;
    case CV_16UC1:
      return highBits(image, bits);
    case CV_16UC3:
    case CV_16UC4:
      return toGray(highBits(image, bits), order);
    case CV_8UC3:
      cv::cvtColor(image, gray, rgb ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
      return gray;
    case CV_8UC4:
      cv::cvtColor(image, gray, rgb ? cv::COLOR_RGBA2GRAY : cv::COLOR_BGRA2GRAY);
      return gray;
    default:
      throw Error("image of OpenCV type " + std::to_string(image.type()) +
                  ": expected 8 or 16 bits with 1, 3 or 4 channels");
  }
}

std::string findFault(const Frame& frame, const Camera& camera) {
  const std::string expected = sizeText(camera.width, camera.height);
  if (!std::isfinite(frame.stamp)) return "the stamp is not finite";
  if (std::abs(frame.stamp) > kMaxStamp) return "the stamp is no time in seconds";
  if (frame.image.type() != CV_8UC1 || frame.image.empty()) {
    return "the image is not 8-bit gray";
  }
  if (frame.image.cols != camera.width || frame.image.rows != camera.height) {
    return "the image has " + sizeText(frame.image.cols, frame.image.rows) +
           " pixels, but the camera " + expected;
  }
  if (frame.depth.empty()) return "there is no depth image";
  if (frame.depth.type() != CV_32FC1 && frame.depth.type() != CV_16UC1) {
    return "the depth is neither 16-bit integer nor 32-bit float with one channel";
  }
  if (frame.depth.cols != camera.width || frame.depth.rows != camera.height) {
    return "the depth has " + sizeText(frame.depth.cols, frame.depth.rows) +
           " pixels, but the image " + expected + ": register it to the color camera";
  }
  if (frame.depth.type() == CV_16UC1 && !(frame.depth_unit > 0.0 && frame.depth_unit <= 1.0)) {
    return "the unit of the depth is not between 0 and 1 m";
  }
  return {};
}

}  // namespace mivo
