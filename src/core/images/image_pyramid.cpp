// SPDX-License-Identifier: BSD-3-Clause
#include "core/images/image_pyramid.h"

#include <algorithm>

#include "core/images/pixel_access.h"
#include "core/kernels/kernels.h"

namespace mivo {
namespace {

// Shorter side >= this, pixels: a coarser level would hold nothing but a few blurred edges.
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
  image.copyTo(levels_[0]);
  scratch_.resize(kernels::imageScratch(image.cols));
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const cv::Mat& fine = levels_[l - 1];
    cv::Mat& coarse = levels_[l];
    coarse.create((fine.rows + 1) / 2, (fine.cols + 1) / 2, CV_32FC1);
    kernels::active().reduce(view(fine), coarse.ptr<float>(),
                             static_cast<std::ptrdiff_t>(coarse.step1()), scratch_.data());
  }
}

}  // namespace mivo
