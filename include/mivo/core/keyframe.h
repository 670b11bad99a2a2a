// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "mivo/core/camera.h"
#include "mivo/core/depth_pyramid.h"
#include "mivo/core/frame.h"
#include "mivo/core/image_pyramid.h"
#include "mivo/core/mi_term.h"
#include "mivo/core/parameters.h"
#include "mivo/core/reference_points.h"

namespace mivo {

/// Whether a level is aligned by mutual information, rather than by SSD (Algorithm 1).
bool usesMutualInformation(const Parameters& parameters, int level);

/// One level of a keyframe.
struct KeyframeLevel {
  ReferencePoints points;
  MiReference mi;  ///< only on levels that use mutual information
};

/// The reference of the alignment: the points of each level, and what depends on them alone. The
/// coarsest level uses all pixels with depth, the others the salient ones (section III-C).
class Keyframe {
 public:
  /// Fills the keyframe from a frame and its pyramid; buffers are reused.
  void build(const ImagePyramid& pyramid, const Frame& frame, const Camera& camera,
             const Parameters& parameters);

  int numLevels() const { return static_cast<int>(levels_.size()); }
  const KeyframeLevel& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }

  /// Points on level 0, where they decide on the precision.
  std::size_t numPoints() const { return levels_.front().points.size(); }
  double medianDepth() const { return static_cast<double>(levels_.front().points.median_depth); }

  const cv::Mat& image() const { return image_; }                   ///< CV_8UC1
  const cv::Mat& depth() const { return depth_pyramid_.level(0); }  ///< CV_32FC1 m, 0: none

 private:
  std::vector<KeyframeLevel> levels_;
  DepthPyramid depth_pyramid_;
  cv::Mat image_;
};

}  // namespace mivo
