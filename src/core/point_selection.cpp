// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/point_selection.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>

#include "mivo/core/depth_pyramid.h"
#include "mivo/core/image_view.h"
#include "mivo/core/kernels/kernels.h"
#include "mivo/core/recycled.h"

namespace mivo {
namespace {

/// Orders the candidates of a cell: the stronger first, of equal ones that which comes first in the
/// image. Squared gradients are not negative, so their bits grow with them.
using Rank = std::uint64_t;

Rank rankOf(float strength, int pixel) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &strength, sizeof(bits));
  return (static_cast<Rank>(bits) << 32U) | (0xFFFFFFFFU - static_cast<std::uint32_t>(pixel));
}

struct Candidate {
  Rank rank;
  Pixel pixel;
};

using Cell = std::vector<Rank>;

/// Intermediate results of a selection.
struct Workspace {
  std::vector<float> squared[3];  // gradients of three rows
  std::vector<std::uint8_t> maximal;
  std::vector<Candidate> candidates;  // in reading order
  std::vector<Cell> cells;
  std::vector<Rank> weakest;  // of the chosen ones of a cell
};

int cellOf(const Pixel& pixel, int columns, int cell_size) {
  return pixel.y / cell_size * columns + pixel.x / cell_size;
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

/// Adds the candidates of one row, whose gradients are squared[1].
void addCandidates(const cv::Mat& depth, int y, const float* squared, const std::uint8_t* maximal,
                   float edge_ratio, std::vector<Candidate>& candidates) {
  const int width = depth.cols;
  for (int x = 2; x + 2 < width; ++x) {
    if (maximal[x] == 0 || !isSmoothDepth(depth, x, y, edge_ratio)) continue;
    candidates.push_back({rankOf(squared[x], y * width + x), {x, y}});
  }
}

/// All salient pixels on smooth surfaces, in reading order.
void findCandidates(const cv::Mat& image, const cv::Mat& depth, const SelectionLimits& limits,
                    Workspace& work) {
  const kernels::Kernels& kernels = kernels::active();
  const kernels::ImageView pixels = view(image);
  const float threshold = limits.min_gradient * limits.min_gradient;
  for (std::vector<float>& row : work.squared) row.resize(static_cast<std::size_t>(image.cols));
  work.maximal.resize(static_cast<std::size_t>(image.cols));
  work.candidates.clear();
  const auto rowOf = [&](int y) { return work.squared[y % 3].data(); };
  // The second derivatives of a point need its eight neighbours, the maximum test their gradients.
  for (int y = 1; y + 1 < image.rows; ++y) {
    kernels.gradientRow(pixels, y, rowOf(y));
    const int middle = y - 1;
    if (middle < 2) continue;
    const float* const rows[3] = {rowOf(middle - 1), rowOf(middle), rowOf(y)};
    kernels.maximaRow(pixels, middle, rows, threshold, work.maximal.data());
    addCandidates(depth, middle, rows[1], work.maximal.data(), limits.depth_edge_ratio,
                  work.candidates);
  }
}

/// The weakest rank of each cell that still is among its `quota` first ones.
void findWeakest(std::size_t quota, Workspace& work) {
  work.weakest.assign(work.cells.size(), 0);
  for (std::size_t c = 0; c < work.cells.size(); ++c) {
    Cell& cell = work.cells[c];
    if (quota == 0) work.weakest[c] = std::numeric_limits<Rank>::max();
    if (quota == 0 || cell.size() <= quota) continue;
    const auto last = cell.begin() + static_cast<std::ptrdiff_t>(quota - 1);
    std::nth_element(cell.begin(), last, cell.end(), std::greater<Rank>());
    work.weakest[c] = *last;
  }
}

}  // namespace

void selectSalient(const cv::Mat& image, const cv::Mat& depth, const SelectionLimits& limits,
                   std::vector<Pixel>& pixels) {
  pixels.clear();
  Recycled<Workspace> recycled;
  Workspace& work = *recycled;
  findCandidates(image, depth, limits, work);
  const int columns = (image.cols + limits.cell_size - 1) / limits.cell_size;
  const int rows = (image.rows + limits.cell_size - 1) / limits.cell_size;
  work.cells.resize(static_cast<std::size_t>(columns * rows));
  for (Cell& cell : work.cells) cell.clear();
  for (const Candidate& candidate : work.candidates) {
    const int cell = cellOf(candidate.pixel, columns, limits.cell_size);
    work.cells[static_cast<std::size_t>(cell)].push_back(candidate.rank);
  }
  findWeakest(quotaPerCell(work.cells, static_cast<std::size_t>(limits.num_points)), work);
  for (const Candidate& candidate : work.candidates) {
    const int cell = cellOf(candidate.pixel, columns, limits.cell_size);
    if (candidate.rank >= work.weakest[static_cast<std::size_t>(cell)]) {
      pixels.push_back(candidate.pixel);
    }
  }
}

void selectAll(const cv::Mat& depth, std::vector<Pixel>& pixels) {
  pixels.clear();
  for (int y = 1; y + 1 < depth.rows; ++y) {
    const auto* row = depth.ptr<float>(y);
    for (int x = 1; x + 1 < depth.cols; ++x) {
      if (row[x] > 0.0F) pixels.push_back({x, y});
    }
  }
}

}  // namespace mivo
