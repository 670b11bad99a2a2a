// SPDX-License-Identifier: BSD-3-Clause
#include "ros/image_conversion.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <string>

#include "mivo/core/error.h"
#include "mivo/core/frame.h"

namespace mivo {
namespace {

namespace encodings = sensor_msgs::image_encodings;

constexpr double kMillimetre = 0.001;

[[noreturn]] void refuse(const std::string& what) {
  throw Error(what);
}

/// Bytes of one pixel. yuv422 has two channels in OpenCV and in ROS.
std::size_t bytesPerPixel(const std::string& encoding) {
  if (encoding == encodings::YUV422) return 2;
  return static_cast<std::size_t>(encodings::numChannels(encoding)) *
         static_cast<std::size_t>(encodings::bitDepth(encoding)) / 8;
}

/// Sizes that contradict each other would make every reader run out of the message.
void checkSizes(const sensor_msgs::Image& message) {
  if (message.width == 0 || message.height == 0) refuse("the image message is empty");
  const std::size_t row = message.width * bytesPerPixel(message.encoding);
  if (message.step < row) {
    refuse("the image message has a step of " + std::to_string(message.step) + " bytes, but " +
           std::to_string(message.width) + " pixels of " + message.encoding + " need " +
           std::to_string(row));
  }
  const std::size_t size = static_cast<std::size_t>(message.step) * message.height;
  if (message.data.size() != size) {
    refuse("the image message holds " + std::to_string(message.data.size()) +
           " bytes, but its step and height make " + std::to_string(size));
  }
}

bool isForeignByteOrder(const sensor_msgs::Image& message) {
  const std::uint16_t one = 1;
  const bool little_endian = *reinterpret_cast<const std::uint8_t*>(&one) == 1;
  return (message.is_bigendian != 0) == little_endian;
}

/// The pixels in this machine's byte order. cv_bridge swaps the bytes but loses the type.
cv::Mat swapped(const sensor_msgs::Image& message, int type) {
  cv::Mat image(static_cast<int>(message.height), static_cast<int>(message.width), type);
  const std::size_t bytes = image.elemSize1();
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

/// The pixels, converted only when `target` names another encoding or the byte order is foreign.
cv::Mat pixels(const sensor_msgs::Image& message, const std::string& target = {}) {
  try {
    const int type = cv_bridge::getCvType(message.encoding);
    if (CV_ELEM_SIZE1(type) > 1 && isForeignByteOrder(message)) return swapped(message, type);
    return cv_bridge::toCvShare(message, boost::shared_ptr<void const>(), target)->image;
  } catch (const std::exception& error) {
    refuse("image of encoding " + message.encoding + ": " + error.what());
  }
}

}  // namespace

ColourImage toColourImage(const sensor_msgs::Image& message) {
  const std::string& encoding = message.encoding;
  const bool grey = encoding == encodings::MONO8 || encoding == encodings::TYPE_8UC1 ||
                    encoding == encodings::MONO16;
  const bool rgb = encoding == encodings::RGB8 || encoding == encodings::RGBA8;
  const bool bgr = encoding == encodings::BGR8 || encoding == encodings::BGRA8;
  const bool mosaic = encodings::isBayer(encoding) && encodings::bitDepth(encoding) == 8;
  if (!grey && !rgb && !bgr && !mosaic && encoding != encodings::YUV422) {
    refuse("colour image of encoding '" + encoding +
           "': expected mono8, mono16, rgb8, bgr8, rgba8, bgra8, bayer_*8 or yuv422; is another "
           "topic connected to "
           "rgb/image?");
  }
  checkSizes(message);
  if (grey || rgb || bgr) {
    return {pixels(message), rgb ? ChannelOrder::kRgb : ChannelOrder::kBgr};
  }
  return {pixels(message, encodings::BGR8), ChannelOrder::kBgr};
}

DepthImage toDepthImage(const sensor_msgs::Image& message) {
  const std::string& encoding = message.encoding;
  const bool integers = encoding == encodings::TYPE_16UC1 || encoding == encodings::MONO16;
  if (!integers && encoding != encodings::TYPE_32FC1) {
    refuse("depth image of encoding '" + encoding +
           "': expected 16UC1 (millimetres) or 32FC1 (metres); is another topic connected to "
           "depth/image?");
  }
  checkSizes(message);
  return {pixels(message), kMillimetre};
}

}  // namespace mivo
