// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/images/contrast_maps.h"
#include "core/images/image_pyramid.h"
#include "core/terms/joint_histogram.h"
#include "mivo/core/frame.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// All data of a frame for the alignment, both as live frame and as keyframe: gray levels, local
/// contrast and normalized images as required by the photometric model, and depth.
class FramePyramid {
 public:
  /// Rebuilds from a frame that fits the camera; buffers are reused. The frame's depth is
  /// referenced, not copied, and read only while the frame is processed.
  void build(const Frame& frame, const Parameters& parameters);

  int numLevels() const { return num_levels_; }
  bool isNormalized() const { return is_normalized_; }

  /// The unmodified image of the frame, CV_8UC1.
  const cv::Mat& image() const { return images_.level(0); }
  /// Image for SSD: CV_8UC1 on level 0, smoothed if isNormalized(); CV_32FC1 0..255 on coarser
  /// levels.
  const cv::Mat& gray(int level) const {
    return level == 0 && is_normalized_ ? smoothed_ : images_.level(level);
  }
  const ContrastMaps& contrast() const { return contrast_; }  ///< if isNormalized()

  /// Image for mutual information on a level that uses it: CV_32FC1 or CV_8UC1, 0..255.
  const cv::Mat& miImage(int level) const;
  /// Its range of gray levels.
  const IntensityRange& miRange(int level) const {
    return ranges_[static_cast<std::size_t>(level)];
  }

  const Frame& frame() const { return frame_; }

  /// Standard deviation of the gray levels of the coarsest level, where noise is averaged out.
  double contrastInView() const;

 private:
  void smooth(double saturation);

  Frame frame_;
  ImagePyramid images_;
  cv::Mat smoothed_;
  std::vector<float> scratch_;
  ContrastMaps contrast_;
  std::vector<cv::Mat> normalized_;
  std::vector<IntensityRange> ranges_;
  int num_levels_ = 0;
  bool is_normalized_ = false;
};

/// Whether a level is aligned by mutual information, rather than by SSD (Algorithm 1).
bool usesMutualInformation(const Parameters& parameters, int level);

}  // namespace mivo
