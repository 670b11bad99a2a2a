// SPDX-License-Identifier: BSD-3-Clause
// Messages of the transports compressed and compressedDepth: the first byte chooses the format, the
// others are the data.
#include <array>

#include "fuzz/fuzz_file.h"
#include "ros/image_conversion.h"

namespace {

constexpr std::array<const char*, 9> kFormats = {"jpeg",
                                                 "png",
                                                 "",
                                                 "bgr8; jpeg compressed bgr8",
                                                 "rgb8; png compressed bgr8",
                                                 "bayer_rggb8; jpeg compressed bayer_rggb8",
                                                 "16UC1; compressedDepth png",
                                                 "32FC1; compressedDepth png",
                                                 "16UC1; compressedDepth rvl"};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  if (count == 0) return 0;
  sensor_msgs::CompressedImage message;
  message.format = kFormats[bytes[0] % kFormats.size()];
  message.data.assign(bytes + 1, bytes + count);
  mivo::expectErrorOrSuccess([&] { mivo::toColorImage(message); });
  mivo::expectErrorOrSuccess([&] { mivo::toDepthImage(message); });
  return 0;
}
