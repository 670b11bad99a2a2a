// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/images/image_pyramid.h"
#include "core/kernels/kernels.h"

namespace mivo {

/// Local mean and standard deviation of one level, for local contrast normalization
/// L = (I - mean) / (deviation + constant): invariant to a gain and an offset of a neighborhood,
/// as caused by lamps and exposure.
struct ContrastMap {
  /// CV_32FC2 (mean, deviation) over 5 x 5 pixels of the image two levels up: pixel (u, v) lies at
  /// (u, v) / 4. The last column and row are repeated, so that every pixel has a neighbor to the
  /// right and below.
  cv::Mat pairs;
  float constant = 1.0F;  ///< gray levels; suppresses noise in flat regions
};

/// As the kernels see it.
kernels::ContrastView view(const ContrastMap& map);

/// The contrast maps of a frame, level by level.
class ContrastMaps {
 public:
  /// The pyramid must have two additional levels; buffers are reused.
  void build(const ImagePyramid& pyramid, int num_levels);

  const ContrastMap& level(int level) const { return maps_[static_cast<std::size_t>(level)]; }

  /// Standard deviation of the noise on level 0, gray levels.
  double noise() const { return noise_; }

 private:
  double noise_ = 0.0;
  std::vector<ContrastMap> maps_;
  std::vector<float> scratch_;
};

/// Normalized intensity at a whole pixel of a level.
float normalizedIntensity(const cv::Mat& image, const ContrastMap& map, int x, int y);

/// Local deviation plus constant at a whole pixel of a level: gray levels per unit of L.
float localContrast(const ContrastMap& map, int x, int y);

/// A whole level, CV_32FC1 or CV_8UC1, normalized and scaled to gray levels, CV_32FC1 0..255, 128
/// for the local mean.
void normalizeImage(const cv::Mat& image, const ContrastMap& map, cv::Mat& normalized);

}  // namespace mivo
