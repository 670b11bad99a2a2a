// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/image_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace mivo {
namespace {

// A coarser level would hold nothing but a few blurred edges.
constexpr int kMinSide = 15;

}  // namespace

int usableLevels(int width, int height, int wanted) {
  int side = std::min(width, height);
  int levels = 1;
  while (levels < wanted && (side + 1) / 2 >= kMinSide) {
    side = (side + 1) / 2;
    ++levels;
  }
  return levels;
}

void ImagePyramid::build(const cv::Mat& image, int num_levels) {
  num_levels_ = num_levels;
  levels_.resize(static_cast<std::size_t>(num_levels));
  image.convertTo(levels_[0], CV_32F);
  for (std::size_t l = 1; l < levels_.size(); ++l) cv::pyrDown(levels_[l - 1], levels_[l]);
}

}  // namespace mivo
