// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "mivo/core/frame.h"

namespace mivo {

/// Color images that repeat the one before while the depth goes on: some drivers and recordings
/// deliver the last image again when the next is late. Light and depth of such a frame are of
/// different times.
class RepeatedImage {
 public:
  /// Why such a frame is left out, the same for all.
  static constexpr const char* kReason =
      "the color image repeats the one before while the depth goes on";

  /// Whether the frame is one, in the order of the stream. Images of one gray (a covered lens), and
  /// frames that repeat the whole of the one before (a camera at rest, without noise) are none.
  bool check(const Frame& frame) {
    const bool is_repeated =
        isSame(frame.image, image_) && !isSame(frame.depth, depth_) && !isUniform(frame.image);
    frame.image.copyTo(image_);  // the frame's memory may be used for the next one
    frame.depth.copyTo(depth_);
    return is_repeated;
  }

 private:
  static bool isSame(const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_L1) == 0.0;
  }

  static bool isUniform(const cv::Mat& image) {
    double least = 0.0;
    double most = 0.0;
    cv::minMaxLoc(image, &least, &most);
    return least == most;
  }

  cv::Mat image_;
  cv::Mat depth_;
};

}  // namespace mivo
