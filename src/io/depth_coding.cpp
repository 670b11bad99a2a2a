// SPDX-License-Identifier: BSD-3-Clause
#include "io/depth_coding.h"

#include <cstdint>

namespace mivo {

void decodeDepth(cv::Mat& depth, DepthCoding coding) {
  if (coding == DepthCoding::kPlain) return;
  for (int y = 0; y < depth.rows; ++y) {
    auto* const row = depth.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth.cols; ++x) {
      const unsigned value = row[x];
      if (coding == DepthCoding::kRotated) {
        row[x] = static_cast<std::uint16_t>(value >> 3 | value << 13);
      } else if (value == 0xFFFF) {
        row[x] = 0;
      }
    }
  }
}

}  // namespace mivo
