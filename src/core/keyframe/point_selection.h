// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace mivo {

/// A pixel of a level.
struct Pixel {
  int x;
  int y;
};

struct SelectionLimits {
  int num_points;      ///< to choose at most
  int num_leading;     ///< number of them that come first: those that a smaller num_points would
                       ///< select
  float min_gradient;  ///< gray levels per pixel
  int cell_size;       ///< pixels; the points are spread evenly over cells of this side
  float depth_edge_ratio;  ///< a point's 3 x 3 readings span at most this share of its depth
};

/// The salient pixels of a level (section III-C): gradient above a threshold, maximal along its
/// direction, on a smooth surface with depth, and distributed over the image: each cell contributes
/// its strongest pixels. First the leading ones in row-major order, then the others. Returns the
/// number of leading ones.
/// @param image CV_32FC1 or CV_8UC1 gray, @param depth CV_32FC1 meters (0: none), same size
std::size_t selectSalient(const cv::Mat& image, const cv::Mat& depth, const SelectionLimits& limits,
                          std::vector<Pixel>& pixels);

/// All pixels with depth except at the border: for the coarsest level, where the test for smooth
/// depth would leave too few.
void selectAll(const cv::Mat& depth, std::vector<Pixel>& pixels);

/// About num_points of those, evenly distributed: for an image without texture.
void selectEvenly(const cv::Mat& depth, int num_points, std::vector<Pixel>& pixels);

}  // namespace mivo
