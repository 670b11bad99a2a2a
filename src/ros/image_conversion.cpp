// SPDX-License-Identifier: BSD-3-Clause
#include "ros/image_conversion.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <opencv2/imgproc.hpp>
#include <string>

#include "mivo/core/error.h"
#include "mivo/core/frame.h"

namespace mivo {
namespace {

namespace encodings = sensor_msgs::image_encodings;

constexpr double kMillimeter = 0.001;

[[noreturn]] void refuse(const std::string& what) {
  throw Error(what);
}

bool isYuyv(const std::string& encoding) {
  return encoding == "yuyv" || encoding == "yuv422_yuy2";
}

/// Luminance in full, followed by color in half the resolution.
bool isTwoPlanes(const std::string& encoding) {
  return encoding == "nv12" || encoding == "nv21";
}

/// Bytes of one pixel in a row.
std::size_t bytesPerPixel(const std::string& encoding) {
  if (encoding == encodings::YUV422 || isYuyv(encoding)) return 2;
  if (isTwoPlanes(encoding)) return 1;
  return static_cast<std::size_t>(encodings::numChannels(encoding)) *
         static_cast<std::size_t>(encodings::bitDepth(encoding)) / 8;
}

/// Sizes that contradict each other would make every reader run out of the message.
/// @param rows  of `step` bytes
void checkSizes(const sensor_msgs::Image& message, std::size_t rows) {
  if (message.width == 0 || message.height == 0) refuse("the image message is empty");
  const std::size_t row = message.width * bytesPerPixel(message.encoding);
  if (message.step < row) {
    refuse("the image message has a step of " + std::to_string(message.step) + " bytes, but " +
           std::to_string(message.width) + " pixels of " + message.encoding + " need " +
           std::to_string(row));
  }
  const std::size_t size = static_cast<std::size_t>(message.step) * rows;
  if (message.data.size() != size) {
    refuse("the image message holds " + std::to_string(message.data.size()) +
           " bytes, but its step and height make " + std::to_string(size));
  }
}

void checkSizes(const sensor_msgs::Image& message) {
  checkSizes(message, message.height);
}

bool isForeignByteOrder(const sensor_msgs::Image& message) {
  const std::uint16_t one = 1;
  const bool little_endian = *reinterpret_cast<const std::uint8_t*>(&one) == 1;
  return (message.is_bigendian != 0) == little_endian;
}

/// The pixels in this machine's byte order and side by side. cv_bridge swaps the bytes but loses
/// the type, and wants rows that begin at a whole element.
cv::Mat copied(const sensor_msgs::Image& message, int type) {
  cv::Mat image(static_cast<int>(message.height), static_cast<int>(message.width), type);
  const std::size_t bytes = isForeignByteOrder(message) ? image.elemSize1() : 1;
  for (int y = 0; y < image.rows; ++y) {
    const std::uint8_t* from = message.data.data() + static_cast<std::size_t>(y) * message.step;
    std::uint8_t* to = image.ptr(y);
    for (std::size_t i = 0; i < static_cast<std::size_t>(image.cols) * image.elemSize();
         i += bytes) {
      std::reverse_copy(from + i, from + i + bytes, to + i);
    }
  }
  return image;
}

/// The pixels, converted only when `target` names another encoding or they lie otherwise in memory.
cv::Mat pixels(const sensor_msgs::Image& message, const std::string& target = {}) {
  try {
    const int type = cv_bridge::getCvType(message.encoding);
    const std::size_t element = CV_ELEM_SIZE1(type);
    if (element > 1 && (isForeignByteOrder(message) || message.step % element != 0)) {
      return copied(message, type);
    }
    return cv_bridge::toCvShare(message, boost::shared_ptr<void const>(), target)->image;
  } catch (const std::exception& error) {
    refuse("image of encoding " + message.encoding + ": " + error.what());
  }
}

/// Of a mosaic of 16 bits, which cv_bridge leaves to others. OpenCV names the four by their second
/// row.
cv::Mat demosaiced16(const sensor_msgs::Image& message) {
  const std::string& encoding = message.encoding;
  const int code = encoding == encodings::BAYER_RGGB16   ? cv::COLOR_BayerBG2BGR
                   : encoding == encodings::BAYER_BGGR16 ? cv::COLOR_BayerRG2BGR
                   : encoding == encodings::BAYER_GBRG16 ? cv::COLOR_BayerGR2BGR
                                                         : cv::COLOR_BayerGB2BGR;
  cv::Mat image;
  cv::cvtColor(pixels(message), image, code);
  return image;
}

/// The bytes of the message as they are.
cv::Mat rawBytes(const sensor_msgs::Image& message, int rows, int type) {
  return cv::Mat(rows, static_cast<int>(message.width), type,
                 const_cast<std::uint8_t*>(message.data.data()), message.step);
}

cv::Mat fromYuyv(const sensor_msgs::Image& message) {
  checkSizes(message);
  cv::Mat image;
  cv::cvtColor(rawBytes(message, static_cast<int>(message.height), CV_8UC2), image,
               cv::COLOR_YUV2BGR_YUY2);
  return image;
}

/// The height of the message is that of the image, or that of both planes.
cv::Mat fromTwoPlanes(const sensor_msgs::Image& message) {
  const bool has_both =
      message.data.size() == static_cast<std::size_t>(message.step) * message.height;
  const std::size_t rows = has_both ? message.height : message.height + message.height / 2;
  if (rows % 3 != 0 || message.width % 2 != 0) {
    refuse("image of encoding " + message.encoding + ": " + std::to_string(message.width) + " x " +
           std::to_string(message.height) + " pixels have no two planes");
  }
  checkSizes(message, rows);
  cv::Mat image;
  cv::cvtColor(rawBytes(message, static_cast<int>(rows), CV_8UC1), image,
               message.encoding == "nv21" ? cv::COLOR_YUV2BGR_NV21 : cv::COLOR_YUV2BGR_NV12);
  return image;
}

bool isOneOf(const std::string& encoding, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), encoding) != names.end();
}

}  // namespace

ColorImage toColorImage(const sensor_msgs::Image& message) {
  const std::string& encoding = message.encoding;
  if (isYuyv(encoding)) return {fromYuyv(message), ChannelOrder::kBgr};
  if (isTwoPlanes(encoding)) return {fromTwoPlanes(message), ChannelOrder::kBgr};
  const bool rgb = isOneOf(encoding, {"rgb8", "rgba8", "rgb16", "rgba16"});
  // Without names of the channels OpenCV's order is meant.
  const bool as_it_is = rgb || isOneOf(encoding, {"mono8", "8UC1", "mono16", "bgr8", "bgra8",
                                                  "bgr16", "bgra16", "8UC3", "8UC4"});
  const bool mosaic = encodings::isBayer(encoding);
  if (!as_it_is && !mosaic && encoding != encodings::YUV422) {
    refuse("color image of encoding '" + encoding +
           "': expected mono8, mono16, rgb8, bgr8, rgba8, bgra8, rgb16, bgr16, 8UC3, bayer_*, "
           "yuv422, yuyv or nv12; is another topic connected to rgb/image?");
  }
  checkSizes(message);
  if (as_it_is) return {pixels(message), rgb ? ChannelOrder::kRgb : ChannelOrder::kBgr};
  if (mosaic && encodings::bitDepth(encoding) == 16) {
    return {demosaiced16(message), ChannelOrder::kBgr};
  }
  return {pixels(message, encodings::BGR8), ChannelOrder::kBgr};
}

DepthImage toDepthImage(const sensor_msgs::Image& message) {
  const std::string& encoding = message.encoding;
  const bool integers = encoding == encodings::TYPE_16UC1 || encoding == encodings::MONO16;
  if (!integers && encoding != encodings::TYPE_32FC1) {
    refuse("depth image of encoding '" + encoding +
           "': expected 16UC1 (millimeters) or 32FC1 (meters); is another topic connected to "
           "depth/image?");
  }
  checkSizes(message);
  return {pixels(message), kMillimeter};
}

}  // namespace mivo
