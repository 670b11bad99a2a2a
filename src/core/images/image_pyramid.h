// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace mivo {

/// Number of levels to use for an image: `wanted`, or fewer so that the coarsest is not too small.
int usableLevels(int width, int height, int wanted);

/// Gray pyramid. Level 0 is the image, CV_8UC1; each further level, CV_32FC1 0..255, is reduced by
/// the 5 x 5 Gaussian of cv::pyrDown, which keeps the even pixels (see Camera::atLevel).
class ImagePyramid {
 public:
  /// Rebuilds all levels from an image CV_8UC1; buffers are reused.
  void build(const cv::Mat& image, int num_levels);

  int numLevels() const { return num_levels_; }
  const cv::Mat& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }

 private:
  std::vector<cv::Mat> levels_;
  std::vector<float> scratch_;
  int num_levels_ = 0;
};

}  // namespace mivo
