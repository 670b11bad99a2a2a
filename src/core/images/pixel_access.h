// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/kernels/image_view.h"

namespace mivo {

/// A CV_32FC1 or CV_8UC1 image as the kernels see it.
inline kernels::ImageView view(const cv::Mat& image) {
  const auto stride = static_cast<std::ptrdiff_t>(image.step1());
  if (image.type() == CV_8UC1) {
    return {nullptr, image.ptr<unsigned char>(), stride, image.cols, image.rows};
  }
  return {image.ptr<float>(), nullptr, stride, image.cols, image.rows};
}

/// Intensity at a whole pixel of such an image.
inline float intensityAt(const cv::Mat& image, int x, int y) {
  return image.type() == CV_8UC1 ? static_cast<float>(image.ptr<unsigned char>(y)[x])
                                 : image.ptr<float>(y)[x];
}

}  // namespace mivo
