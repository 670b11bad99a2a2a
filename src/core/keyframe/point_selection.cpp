// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/point_selection.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>

#include "core/execution/recycled.h"
#include "core/images/pixel_access.h"
#include "core/kernels/kernels.h"

namespace mivo {
namespace {

/// Orders the candidates of a cell: the stronger first, of equal ones that which comes first in the
/// image. Squared gradients are not negative, so their bits grow with them.
using Rank = std::uint64_t;

Rank rankOf(float strength, std::uint32_t pixel) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &strength, sizeof(bits));
  return (static_cast<Rank>(bits) << 32U) | (0xFFFFFFFFU - pixel);
}

struct Candidate {
  Rank rank;
  std::uint16_t x;
  std::uint16_t y;
  std::uint32_t cell;
};

// Ranks are counted by the leading bits of their strength: 8 steps in each octave from 2^-8 to 2^24
// and the two ends. The last rank to be chosen is then sought among few.
constexpr std::uint32_t kSteps = 256;
constexpr std::uint32_t kShift = 52;  // of a rank: 32 bits of the pixel and 20 of the mantissa
constexpr std::uint32_t kFirstStep = (127U - 8U) << 3U;

std::uint32_t stepOf(Rank rank) {
  const auto leading = static_cast<std::uint32_t>(rank >> kShift);
  return leading < kFirstStep ? 0U : std::min(leading - kFirstStep, kSteps - 1U);
}

struct Cell {
  std::uint32_t size;       // candidates in it
  std::uint32_t last_step;  // in which the last one is chosen
  std::uint32_t rest;       // how many of this step are chosen
  Rank weakest;             // of the chosen ones
  Rank given;               // weakest of those taken before
};

/// Intermediate results of a selection.
struct Workspace {
  std::vector<float> squared[3];         // gradients of three rows
  std::vector<std::uint32_t> column_of;  // of cells, for each pixel of a row
  std::vector<std::uint8_t> marks;       // of the candidates of one row
  std::size_t num_candidates = 0;
  std::vector<Candidate> candidates;  // in reading order
  std::vector<Pixel> chosen;
  std::vector<Cell> cells;
  std::vector<std::uint32_t> counts;     // kSteps for each cell
  std::vector<std::vector<Rank>> ranks;  // of the last step of each cell
};

/// Largest number per cell whose sum over the cells does not exceed `wanted`.
std::uint32_t quotaPerCell(const std::vector<Cell>& cells, std::uint32_t wanted) {
  std::uint32_t low = 0;
  std::uint32_t high = wanted;
  while (low < high) {
    const std::uint32_t middle = low + (high - low + 1) / 2;
    std::uint64_t sum = 0;
    for (const Cell& cell : cells) sum += std::min(cell.size, middle);
    if (sum <= wanted) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

/// Adds what is marked in a row. @param first_cell of the row of cells.
void addCandidates(int y, std::uint32_t first_cell, const float* squared, Workspace& work) {
  // Whole eights without a mark are passed over. In the others each pixel is written and counted
  // only if it is marked: a processor cannot foresee the marks, so no branch asks for them.
  constexpr std::size_t kTogether = 8;
  const std::size_t width = work.marks.size();
  const auto first_pixel = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width);
  std::size_t count = work.num_candidates;
  if (work.candidates.size() < count + width + 1) {
    work.candidates.resize(2 * (count + width + 1));
  }
  Candidate* candidates = work.candidates.data();
  for (std::size_t x = 0; x < width;) {
    std::uint64_t marked = 1;
    if (x + kTogether <= width) std::memcpy(&marked, work.marks.data() + x, kTogether);
    const std::size_t end = std::min(width, x + kTogether);
    for (; marked != 0 && x < end; ++x) {
      const std::uint32_t pixel = first_pixel + static_cast<std::uint32_t>(x);
      candidates[count] = {rankOf(squared[x], pixel), static_cast<std::uint16_t>(x),
                           static_cast<std::uint16_t>(y), first_cell + work.column_of[x]};
      count += work.marks[x];
    }
    x = end;
  }
  work.num_candidates = count;
}

/// All salient pixels on smooth surfaces, in reading order.
void findCandidates(const cv::Mat& image, const cv::Mat& depth, const SelectionLimits& limits,
                    int cell_columns, Workspace& work) {
  const kernels::Kernels& kernels = kernels::active();
  const kernels::ImageView pixels = view(image);
  const float threshold = limits.min_gradient * limits.min_gradient;
  for (std::vector<float>& row : work.squared) row.resize(static_cast<std::size_t>(image.cols));
  work.marks.resize(static_cast<std::size_t>(image.cols));
  work.column_of.resize(static_cast<std::size_t>(image.cols));
  for (int x = 0; x < image.cols; ++x) {
    work.column_of[static_cast<std::size_t>(x)] = static_cast<std::uint32_t>(x / limits.cell_size);
  }
  work.num_candidates = 0;
  const auto rowOf = [&](int y) { return work.squared[y % 3].data(); };
  // The second derivatives of a point need its eight neighbors, the maximum test their gradients.
  for (int y = 1; y + 1 < image.rows; ++y) {
    kernels.gradientRow(pixels, y, rowOf(y));
    const int middle = y - 1;
    if (middle < 2) continue;
    const float* const rows[3] = {rowOf(middle - 1), rowOf(middle), rowOf(y)};
    kernels.maximaRow(pixels, middle, rows, threshold, work.marks.data());
    const float* const depths[3] = {depth.ptr<float>(middle - 1), depth.ptr<float>(middle),
                                    depth.ptr<float>(middle + 1)};
    kernels.keepSmooth(depths, image.cols, limits.depth_edge_ratio, 2, work.marks.data());
    addCandidates(middle, static_cast<std::uint32_t>(middle / limits.cell_size * cell_columns),
                  rows[1], work);
  }
}

void countCandidates(std::size_t num_cells, Workspace& work) {
  work.cells.assign(num_cells, Cell{0, 0, 0, 0, std::numeric_limits<Rank>::max()});
  work.counts.assign(num_cells * kSteps, 0);
  for (std::size_t i = 0; i < work.num_candidates; ++i) {
    const Candidate& candidate = work.candidates[i];
    ++work.cells[candidate.cell].size;
    ++work.counts[candidate.cell * kSteps + stepOf(candidate.rank)];
  }
}

/// The step in which a cell fills its quota; none when it has no more candidates than that.
void findLastStep(const std::uint32_t* counts, std::uint32_t quota, Cell& cell) {
  cell.last_step = kSteps;  // none
  if (cell.size <= quota) return;
  std::uint32_t rest = quota;
  std::uint32_t step = kSteps - 1;
  while (counts[step] < rest) rest -= counts[step--];
  cell.last_step = step;
  cell.rest = rest;
}

/// The weakest rank of each cell that still is among its `quota` first ones.
void findWeakest(std::uint32_t quota, Workspace& work) {
  work.ranks.resize(std::max(work.ranks.size(), work.cells.size()));
  for (std::size_t c = 0; c < work.cells.size(); ++c) {
    findLastStep(work.counts.data() + c * kSteps, quota, work.cells[c]);
    work.ranks[c].clear();
  }
  for (std::size_t i = 0; i < work.num_candidates; ++i) {
    const Candidate& candidate = work.candidates[i];
    if (stepOf(candidate.rank) == work.cells[candidate.cell].last_step) {
      work.ranks[candidate.cell].push_back(candidate.rank);
    }
  }
  for (std::size_t c = 0; c < work.cells.size(); ++c) {
    Cell& cell = work.cells[c];
    if (cell.last_step == kSteps) {  // all are chosen
      cell.weakest = 0;
      continue;
    }
    if (cell.rest == 0) {  // none is: the quota is 0
      cell.weakest = std::numeric_limits<Rank>::max();
      continue;
    }
    std::vector<Rank>& ranks = work.ranks[c];
    const auto last = ranks.begin() + static_cast<std::ptrdiff_t>(cell.rest - 1);
    std::nth_element(ranks.begin(), last, ranks.end(), std::greater<Rank>());
    cell.weakest = *last;
  }
}

/// Appends the candidates that the cells choose and have not given before to `count` chosen ones.
/// Returns how many there are then.
std::size_t takeChosen(std::size_t count, Workspace& work) {
  // Again without a branch that nothing foresees.
  work.chosen.resize(std::max(work.chosen.size(), work.num_candidates + 1));
  for (std::size_t i = 0; i < work.num_candidates; ++i) {
    const Candidate& candidate = work.candidates[i];
    const Cell& cell = work.cells[candidate.cell];
    work.chosen[count] = {candidate.x, candidate.y};
    count += (candidate.rank >= cell.weakest ? 1U : 0U) & (candidate.rank < cell.given ? 1U : 0U);
  }
  for (Cell& cell : work.cells) cell.given = cell.weakest;
  return count;
}

/// Sets the weakest rank of each cell when `num_points` are chosen.
void fillCells(int num_points, Workspace& work) {
  findWeakest(quotaPerCell(work.cells, static_cast<std::uint32_t>(num_points)), work);
}

}  // namespace

std::size_t selectSalient(const cv::Mat& image, const cv::Mat& depth, const SelectionLimits& limits,
                          std::vector<Pixel>& pixels) {
  Recycled<Workspace> recycled;
  Workspace& work = *recycled;
  const int columns = (image.cols + limits.cell_size - 1) / limits.cell_size;
  const int rows = (image.rows + limits.cell_size - 1) / limits.cell_size;
  findCandidates(image, depth, limits, columns, work);
  countCandidates(static_cast<std::size_t>(columns * rows), work);
  fillCells(limits.num_leading, work);
  const std::size_t num_leading = takeChosen(0, work);
  fillCells(limits.num_points, work);
  const std::size_t count = takeChosen(num_leading, work);
  pixels.assign(work.chosen.begin(), work.chosen.begin() + static_cast<std::ptrdiff_t>(count));
  return num_leading;
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

void selectEvenly(const cv::Mat& depth, int num_points, std::vector<Pixel>& pixels) {
  selectAll(depth, pixels);
  const std::size_t stride =
      std::max<std::size_t>(1, pixels.size() / static_cast<std::size_t>(num_points));
  const std::size_t count = (pixels.size() + stride - 1) / stride;
  for (std::size_t i = 0; i < count; ++i) pixels[i] = pixels[i * stride];
  pixels.resize(count);
}

}  // namespace mivo
