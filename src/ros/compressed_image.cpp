// SPDX-License-Identifier: BSD-3-Clause
// Decoding of compressed images. The plugins of image_transport that would do it are not packaged
// everywhere, and bags with compressed topics are the common ones.
#include <cv_bridge/cv_bridge.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "io/image_decoding.h"
#include "mivo/core/error.h"
#include "mivo/core/frame.h"
#include "ros/image_conversion.h"

namespace mivo {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 2> kJpegSignature = {0xff, 0xd8};
// Header of compressedDepth: int32 format, then the two float parameters of the quantization.
constexpr std::size_t kDepthHeaderBytes = 12;

template <typename Signature>
bool startsWith(const Bytes& data, std::size_t offset, const Signature& signature) {
  return data.size() >= offset + signature.size() &&
         std::equal(signature.begin(), signature.end(),
                    data.begin() + static_cast<std::ptrdiff_t>(offset));
}

/// Decodes a JPEG or PNG that starts at `offset`.
cv::Mat decode(const sensor_msgs::CompressedImage& message, std::size_t offset) {
  const Bytes& data = message.data;
  const std::string name = "compressed image of format '" + message.format + "'";
  if (!startsWith(data, offset, kPngSignature) && !startsWith(data, offset, kJpegSignature)) {
    throw Error(name + ": its data are neither JPEG nor PNG; record it raw or with another format");
  }
  return decodeImage(data.data() + offset, data.size() - offset, name);
}

/// Order of the channels after decoding. "rgb8; jpeg compressed bgr8" says how the pixels were
/// ordered when they were encoded as if blue came first.
ChannelOrder channelOrder(const std::string& format) {
  const std::string word = "compressed ";
  const std::size_t at = format.find(word);
  const bool rgb = at != std::string::npos && format.compare(at + word.size(), 3, "rgb") == 0;
  return rgb ? ChannelOrder::kRgb : ChannelOrder::kBgr;
}

/// Meters of a quantized inverse depth, as compressedDepth stores 32FC1.
cv::Mat dequantize(const cv::Mat& quantized, float a, float b) {
  cv::Mat depth(quantized.size(), CV_32FC1);
  for (int y = 0; y < quantized.rows; ++y) {
    const auto* from = quantized.ptr<std::uint16_t>(y);
    auto* to = depth.ptr<float>(y);
    for (int x = 0; x < quantized.cols; ++x) {
      to[x] = from[x] == 0 ? std::numeric_limits<float>::quiet_NaN()
                           : a / (static_cast<float>(from[x]) - b);
    }
  }
  return depth;
}

/// RVL (A. D. Wilson, Fast Lossless Depth Image Compression, 2017) as
/// compressed_depth_image_transport writes it: columns and rows as int32, then words of eight
/// nibbles, the highest first. A number is nibbles of three bits, the lowest first, with the fourth
/// set when more follow. Runs of zeros and of readings take turns; a reading is the zigzag
/// difference to the one before.
class RvlDecoder {
 public:
  RvlDecoder(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), words_(size / 4) {}

  /// Throws Error when the numbers do not make an image of this size.
  cv::Mat decode(int columns, int rows) {
    cv::Mat image(rows, columns, CV_16UC1);
    auto* depth = image.ptr<std::uint16_t>();
    std::size_t left = image.total();
    std::uint64_t reading = 0;  // whole turns cancel; damaged numbers may be of any size
    while (left > 0) {
      const std::size_t zeros = run(left);
      depth = std::fill_n(depth, zeros, std::uint16_t{0});
      left -= zeros;
      const std::size_t readings = run(left);
      left -= readings;
      for (std::size_t i = 0; i < readings; ++i) {
        const std::uint64_t zigzag = number();
        reading += (zigzag >> 1) ^ (0 - (zigzag & 1));
        *depth++ = static_cast<std::uint16_t>(reading);
      }
      if (zeros + readings == 0 && left > 0) refuse();
    }
    return image;
  }

 private:
  [[noreturn]] static void refuse() { throw Error("compressed depth: its RVL is damaged"); }

  std::size_t run(std::size_t left) {
    const std::uint64_t length = number();
    if (length > left) refuse();
    return static_cast<std::size_t>(length);
  }

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 60; shift += 3) {
      const unsigned part = nibble();
      value |= static_cast<std::uint64_t>(part & 7U) << shift;
      if ((part & 8U) == 0) return value;
    }
    refuse();
  }

  unsigned nibble() {
    if (nibbles_ == 0) {
      if (next_ == words_) refuse();
      std::memcpy(&word_, bytes_ + 4 * next_++, 4);
      nibbles_ = 8;
    }
    return word_ >> 4 * --nibbles_ & 15U;
  }

  const std::uint8_t* bytes_;
  std::size_t words_;
  std::size_t next_ = 0;
  std::uint32_t word_ = 0;
  int nibbles_ = 0;  // of the word, left
};

cv::Mat decodeRvl(const Bytes& data) {
  std::array<std::int32_t, 2> size{};
  const std::size_t begin = kDepthHeaderBytes + sizeof(size);
  if (data.size() < begin) throw Error("compressed depth: its RVL is truncated");
  std::memcpy(size.data(), data.data() + kDepthHeaderBytes, sizeof(size));
  if (size[0] <= 0 || size[1] <= 0 ||
      static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) > kMaxImagePixels) {
    throw Error("compressed depth: its RVL is of " + std::to_string(size[0]) + " x " +
                std::to_string(size[1]) + " pixels");
  }
  return RvlDecoder(data.data() + begin, data.size() - begin).decode(size[0], size[1]);
}

}  // namespace

ColorImage toColorImage(const sensor_msgs::CompressedImage& message) {
  const cv::Mat image = decode(message, 0);
  const std::string encoding = message.format.substr(0, message.format.find(';'));
  if (image.channels() != 1 || encoding.rfind("bayer_", 0) != 0) {
    return {image, channelOrder(message.format)};
  }
  sensor_msgs::Image mosaic;
  cv_bridge::CvImage(message.header, encoding, image).toImageMsg(mosaic);
  const ColorImage color = toColorImage(mosaic);
  return {color.image.clone(), color.order};
}

DepthImage toDepthImage(const sensor_msgs::CompressedImage& message) {
  const bool plain = startsWith(message.data, 0, kPngSignature);
  const bool rvl = message.format.find("compressedDepth rvl") != std::string::npos;
  if (!plain && !rvl && !startsWith(message.data, kDepthHeaderBytes, kPngSignature)) {
    throw Error("compressed depth of format '" + message.format +
                "': expected PNG or RVL; JPEG loses depth");
  }
  const cv::Mat image =
      rvl ? decodeRvl(message.data) : decode(message, plain ? 0 : kDepthHeaderBytes);
  if (image.type() != CV_16UC1) {
    throw Error("compressed depth of format '" + message.format + "' has not 16 bits");
  }
  if (plain || message.format.compare(0, 5, "32FC1") != 0) return {image, 0.001};

  std::array<float, 2> quantization{};
  std::memcpy(quantization.data(), message.data.data() + sizeof(std::int32_t),
              sizeof(quantization));
  return {dequantize(image, quantization[0], quantization[1]), 0.001};
}

}  // namespace mivo
