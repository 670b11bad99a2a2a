// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/depth_pyramid.h"

#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

void toMetres(const Frame& frame, float min_depth, float max_depth, cv::Mat& metres) {
  metres.create(frame.depth.size(), CV_32FC1);
  const auto limited = [=](float z) { return z >= min_depth && z <= max_depth ? z : 0.0F; };
  const auto unit = static_cast<float>(frame.depth_unit);
  for (int y = 0; y < metres.rows; ++y) {
    auto* row = metres.ptr<float>(y);
    if (frame.depth.type() == CV_16UC1) {
      const auto* raw = frame.depth.ptr<unsigned short>(y);
      for (int x = 0; x < metres.cols; ++x) row[x] = limited(depthInMetres(raw[x], unit));
    } else {
      const auto* raw = frame.depth.ptr<float>(y);
      for (int x = 0; x < metres.cols; ++x) row[x] = limited(raw[x]);
    }
  }
}

/// Mean of those in the 3 x 3 around (x, y) that differ from it by at most the ratio; 0 for a hole.
float meanOfSurface(const cv::Mat& depth, int x, int y, float ratio) {
  const float centre = depth.at<float>(y, x);
  if (centre <= 0.0F) return 0.0F;
  float sum = 0.0F;
  float count = 0.0F;
  for (int v = std::max(0, y - 1); v <= std::min(depth.rows - 1, y + 1); ++v) {
    const auto* row = depth.ptr<float>(v);
    for (int u = std::max(0, x - 1); u <= std::min(depth.cols - 1, x + 1); ++u) {
      if (std::abs(row[u] - centre) <= ratio * centre) {
        sum += row[u];
        count += 1.0F;
      }
    }
  }
  return sum / count;
}

void reduce(const cv::Mat& fine, float ratio, cv::Mat& coarse) {
  coarse.create((fine.rows + 1) / 2, (fine.cols + 1) / 2, CV_32FC1);
  for (int y = 0; y < coarse.rows; ++y) {
    auto* row = coarse.ptr<float>(y);
    for (int x = 0; x < coarse.cols; ++x) row[x] = meanOfSurface(fine, 2 * x, 2 * y, ratio);
  }
}

}  // namespace

void DepthPyramid::build(const Frame& frame, int num_levels, double min_depth, double max_depth,
                         double edge_ratio) {
  levels_.resize(static_cast<std::size_t>(num_levels));
  toMetres(frame, static_cast<float>(min_depth), static_cast<float>(max_depth), levels_[0]);
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    reduce(levels_[l - 1], static_cast<float>(0.5 * edge_ratio), levels_[l]);
  }
}

bool isSmoothDepth(const cv::Mat& depth, int x, int y, float edge_ratio) {
  const float centre = depth.at<float>(y, x);
  float lowest = centre;
  float highest = centre;
  for (int v = y - 1; v <= y + 1; ++v) {
    const auto* row = depth.ptr<float>(v);
    for (int u = x - 1; u <= x + 1; ++u) {
      lowest = std::min(lowest, row[u]);
      highest = std::max(highest, row[u]);
    }
  }
  return lowest > 0.0F && highest - lowest <= edge_ratio * centre;
}

}  // namespace mivo
