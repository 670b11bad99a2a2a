// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/point_selection.h"

#include <algorithm>
#include <cmath>

#include "mivo/core/depth_pyramid.h"
#include "mivo/core/image_view.h"

namespace mivo {
namespace {

struct Candidate {
  float strength;  // squared gradient
  Pixel pixel;
};

using Cell = std::vector<Candidate>;

cv::Mat squaredGradient(const cv::Mat& image) {
  cv::Mat result = cv::Mat::zeros(image.size(), CV_32FC1);
  for (int y = 1; y + 1 < image.rows; ++y) {
    auto* out = result.ptr<float>(y);
    for (int x = 1; x + 1 < image.cols; ++x) {
      const float gx = 0.5F * (intensityAt(image, x + 1, y) - intensityAt(image, x - 1, y));
      const float gy = 0.5F * (intensityAt(image, x, y + 1) - intensityAt(image, x, y - 1));
      out[x] = gx * gx + gy * gy;
    }
  }
  return result;
}

/// Whether the squared gradient is maximal among the two neighbours in the gradient's direction,
/// rounded to one of four. Of two equal neighbours the later one counts.
bool isMaximal(const cv::Mat& image, const cv::Mat& strength, int x, int y) {
  constexpr float kTan22_5 = 0.41421356F;
  const float gx = intensityAt(image, x + 1, y) - intensityAt(image, x - 1, y);
  const float gy = intensityAt(image, x, y + 1) - intensityAt(image, x, y - 1);
  const float ax = std::abs(gx);
  const float ay = std::abs(gy);
  int dx = 1;
  int dy = 0;
  if (ay > ax * kTan22_5) {
    dy = gx * gy >= 0.0F ? 1 : -1;
    if (ax <= ay * kTan22_5) {
      dx = 0;
      dy = 1;
    }
  }
  const float here = strength.at<float>(y, x);
  const bool backwards_later = dy < 0;  // which of the two neighbours comes later in the image
  const float first = strength.at<float>(y - dy, x - dx);
  const float second = strength.at<float>(y + dy, x + dx);
  return backwards_later ? here >= second && here > first : here >= first && here > second;
}

/// Largest number per cell whose sum over the cells does not exceed `wanted`.
std::size_t quotaPerCell(const std::vector<Cell>& cells, std::size_t wanted) {
  std::size_t low = 0;
  std::size_t high = wanted;
  while (low < high) {
    const std::size_t middle = (low + high + 1) / 2;
    std::size_t sum = 0;
    for (const Cell& cell : cells) sum += std::min(cell.size(), middle);
    if (sum <= wanted) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

bool inReadingOrder(const Pixel& a, const Pixel& b) {
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

}  // namespace

std::vector<Pixel> selectSalient(const cv::Mat& image, const cv::Mat& depth,
                                 const SelectionLimits& limits) {
  const cv::Mat strength = squaredGradient(image);
  const int columns = (image.cols + limits.cell_size - 1) / limits.cell_size;
  const int rows = (image.rows + limits.cell_size - 1) / limits.cell_size;
  std::vector<Cell> cells(static_cast<std::size_t>(columns * rows));
  const float threshold = limits.min_gradient * limits.min_gradient;
  // The second derivatives of a point need its eight neighbours, the maximum test their gradients.
  for (int y = 2; y + 2 < image.rows; ++y) {
    const auto* row = strength.ptr<float>(y);
    for (int x = 2; x + 2 < image.cols; ++x) {
      if (row[x] <= 0.0F || row[x] < threshold || !isMaximal(image, strength, x, y) ||
          !isSmoothDepth(depth, x, y, limits.depth_edge_ratio)) {
        continue;
      }
      const int cell = y / limits.cell_size * columns + x / limits.cell_size;
      cells[static_cast<std::size_t>(cell)].push_back({row[x], {x, y}});
    }
  }
  const std::size_t quota = quotaPerCell(cells, static_cast<std::size_t>(limits.num_points));
  std::vector<Pixel> pixels;
  for (Cell& cell : cells) {
    const auto end = cell.begin() + static_cast<std::ptrdiff_t>(std::min(quota, cell.size()));
    std::partial_sort(cell.begin(), end, cell.end(), [](const Candidate& a, const Candidate& b) {
      return a.strength != b.strength ? a.strength > b.strength : inReadingOrder(a.pixel, b.pixel);
    });
    for (auto candidate = cell.begin(); candidate != end; ++candidate) {
      pixels.push_back(candidate->pixel);
    }
  }
  std::sort(pixels.begin(), pixels.end(), inReadingOrder);
  return pixels;
}

std::vector<Pixel> selectAll(const cv::Mat& depth) {
  std::vector<Pixel> pixels;
  for (int y = 1; y + 1 < depth.rows; ++y) {
    const auto* row = depth.ptr<float>(y);
    for (int x = 1; x + 1 < depth.cols; ++x) {
      if (row[x] > 0.0F) pixels.push_back({x, y});
    }
  }
  return pixels;
}

}  // namespace mivo
