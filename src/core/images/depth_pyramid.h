// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/kernels/image_view.h"
#include "mivo/core/frame.h"

namespace mivo {

/// Depth pyramid of a keyframe, CV_32FC1 in meters, 0 where there is no reading. Pixel (x, y) of a
/// level lies at (2x, 2y) of the finer one, as in ImagePyramid: a hole there stays a hole, and the
/// mean is taken over those of its 3 x 3 neighbors that lie on the same surface.
class DepthPyramid {
 public:
  /// Readings outside of [min_depth, max_depth] count as holes. Neighbors on the same surface
  /// differ from the pixel by at most half the edge ratio.
  void build(const Frame& frame, int num_levels, double min_depth, double max_depth,
             double edge_ratio);

  const cv::Mat& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }

 private:
  std::vector<cv::Mat> levels_;
};

/// The readings of a frame as the kernels see them.
kernels::DepthView depthView(const Frame& frame);

/// One reading, m; 0 for none.
float depthAt(const kernels::DepthView& depth, int x, int y);

}  // namespace mivo
