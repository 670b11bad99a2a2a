// SPDX-License-Identifier: BSD-3-Clause
// Decoding of compressed images. The plugins of image_transport that would do it are not packaged
// everywhere, and bags with compressed topics are the common ones.
#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "mivo/core/error.h"
#include "mivo/core/frame.h"
#include "ros/image_conversion.h"

namespace mivo {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 2> kJpegSignature = {0xff, 0xd8};
constexpr std::array<std::uint8_t, 2> kJpegEnd = {0xff, 0xd9};
constexpr std::array<std::uint8_t, 4> kPngEnd = {'I', 'E', 'N', 'D'};
// An encoder may pad its output; the end mark is looked for in the last bytes only.
constexpr std::ptrdiff_t kTailBytes = 64;

// Header of compressedDepth: int32 format, then the two float parameters of the quantisation.
constexpr std::size_t kDepthHeaderBytes = 12;

template <typename Signature>
bool startsWith(const Bytes& data, std::size_t offset, const Signature& signature) {
  return data.size() >= offset + signature.size() &&
         std::equal(signature.begin(), signature.end(),
                    data.begin() + static_cast<std::ptrdiff_t>(offset));
}

template <typename Mark>
bool endsWith(const Bytes& data, const Mark& mark) {
  const auto tail = data.end() - std::min(kTailBytes, data.end() - data.begin());
  return std::search(tail, data.end(), mark.begin(), mark.end()) != data.end();
}

/// Decodes a JPEG or PNG that starts at `offset`. A decoder would return the part of a truncated
/// image that it could make sense of: its end is looked for first.
cv::Mat decode(const sensor_msgs::CompressedImage& message, std::size_t offset) {
  const Bytes& data = message.data;
  const bool png = startsWith(data, offset, kPngSignature);
  const bool jpeg = startsWith(data, offset, kJpegSignature);
  if (!png && !jpeg) {
    throw Error("compressed image of format '" + message.format +
                "': its data are neither JPEG nor PNG; record it raw or with another format");
  }
  if (png ? !endsWith(data, kPngEnd) : !endsWith(data, kJpegEnd)) {
    throw Error("compressed image of format '" + message.format + "' is truncated");
  }
  const cv::Mat encoded(1, static_cast<int>(data.size() - offset), CV_8UC1,
                        const_cast<std::uint8_t*>(data.data()) + offset);
  cv::Mat image;
  try {
    image = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    // A size beyond what it wants to decode; other damage gives an empty image.
  }
  if (image.empty()) {
    throw Error("compressed image of format '" + message.format + "' is damaged");
  }
  return image;
}

/// Order of the channels after decoding. "rgb8; jpeg compressed bgr8" says how the pixels were
/// ordered when they were encoded as if blue came first.
ChannelOrder channelOrder(const std::string& format) {
  const std::string word = "compressed ";
  const std::size_t at = format.find(word);
  const bool rgb = at != std::string::npos && format.compare(at + word.size(), 3, "rgb") == 0;
  return rgb ? ChannelOrder::kRgb : ChannelOrder::kBgr;
}

/// Metres of a quantised inverse depth, as compressedDepth stores 32FC1.
cv::Mat dequantise(const cv::Mat& quantised, float a, float b) {
  cv::Mat depth(quantised.size(), CV_32FC1);
  for (int y = 0; y < quantised.rows; ++y) {
    const auto* from = quantised.ptr<std::uint16_t>(y);
    auto* to = depth.ptr<float>(y);
    for (int x = 0; x < quantised.cols; ++x) {
      to[x] = from[x] == 0 ? std::numeric_limits<float>::quiet_NaN()
                           : a / (static_cast<float>(from[x]) - b);
    }
  }
  return depth;
}

}  // namespace

ColourImage toColourImage(const sensor_msgs::CompressedImage& message) {
  return {decode(message, 0), channelOrder(message.format)};
}

DepthImage toDepthImage(const sensor_msgs::CompressedImage& message) {
  const bool plain = startsWith(message.data, 0, kPngSignature);
  if (!plain && !startsWith(message.data, kDepthHeaderBytes, kPngSignature)) {
    throw Error("compressed depth of format '" + message.format +
                "': expected PNG; JPEG loses depth, and RVL is not supported");
  }
  const cv::Mat image = decode(message, plain ? 0 : kDepthHeaderBytes);
  if (image.type() != CV_16UC1) {
    throw Error("compressed depth of format '" + message.format + "' has not 16 bits");
  }
  if (plain || message.format.compare(0, 5, "32FC1") != 0) return {image, 0.001};

  std::array<float, 2> quantisation{};
  std::memcpy(quantisation.data(), message.data.data() + sizeof(std::int32_t),
              sizeof(quantisation));
  return {dequantise(image, quantisation[0], quantisation[1]), 0.001};
}

}  // namespace mivo
