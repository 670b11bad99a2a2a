// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

namespace mivo {

/// How many of 16 bits the color images of a stream use: cameras of 10, 12 or 14 bits fill the
/// low ones, and toGray() has to know, or most of the light is lost. The first image tells; when a
/// later one is brighter, the range grows and stays.
class GrayRange {
 public:
  /// @param image  any; of 8 bits, nothing is learned
  /// @return for toGray(): 8, 10, 12, 14 or 16
  int include(const cv::Mat& image) {
    if (image.depth() != CV_16U || image.empty()) return bits_;
    double brightest = 0.0;
    cv::minMaxLoc(image.reshape(1), nullptr, &brightest);
    while (bits_ < 16 && brightest >= 1 << bits_) bits_ += 2;
    return bits_;
  }

 private:
  int bits_ = 8;
};

}  // namespace mivo
