// SPDX-License-Identifier: BSD-3-Clause
#include "session/depth_enlargement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace mivo {
namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
// Readings further apart than this share of their depth are of different surfaces.
constexpr float kSameSurface = 0.05F;

/// Between readings. The inverse depth of a plane is linear in the pixel.
float interpolated(const cv::Mat& depth, double unit, float x, float y) {
  const int columns = depth.cols;
  const int rows = depth.rows;
  const int left = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(0, columns - 2));
  const int top = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(0, rows - 2));
  const int nearest_x = std::clamp(static_cast<int>(std::lround(x)), 0, columns - 1);
  const int nearest_y = std::clamp(static_cast<int>(std::lround(y)), 0, rows - 1);
  const float nearest = depthInMeters(depth, unit, nearest_x, nearest_y);
  if (columns < 2 || rows < 2 || std::isnan(nearest)) return nearest;
  const float corners[4] = {
      depthInMeters(depth, unit, left, top), depthInMeters(depth, unit, left + 1, top),
      depthInMeters(depth, unit, left, top + 1), depthInMeters(depth, unit, left + 1, top + 1)};
  for (const float corner : corners) {
    if (!(std::abs(corner - nearest) <= kSameSurface * nearest)) return nearest;
  }
  const float u = x - static_cast<float>(left);
  const float v = y - static_cast<float>(top);
  const float upper = (1.0F - u) / corners[0] + u / corners[1];
  const float lower = (1.0F - u) / corners[2] + u / corners[3];
  return 1.0F / ((1.0F - v) * upper + v * lower);
}

}  // namespace

bool isWholeMultiple(const cv::Size& large, const cv::Size& small) {
  if (small.width <= 0 || small.height <= 0) return false;
  const int factor = large.width / small.width;
  return factor > 1 && factor * small.width == large.width && factor * small.height == large.height;
}

float depthInMeters(const cv::Mat& depth, double unit, int x, int y) {
  const float meters =
      depth.type() == CV_16UC1
          ? static_cast<float>(depth.at<std::uint16_t>(y, x)) * static_cast<float>(unit)
          : depth.at<float>(y, x);
  return meters > 0.0F && std::isfinite(meters) ? meters : kNoReading;
}

cv::Mat enlargeDepth(const cv::Mat& depth, double unit, const cv::Size& size) {
  cv::Mat large(size, CV_32FC1);
  const float scale = static_cast<float>(depth.cols) / static_cast<float>(size.width);
  for (int y = 0; y < size.height; ++y) {
    auto* row = large.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      row[x] = interpolated(depth, unit, (static_cast<float>(x) + 0.5F) * scale - 0.5F,
                            (static_cast<float>(y) + 0.5F) * scale - 0.5F);
    }
  }
  return large;
}

}  // namespace mivo
