// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/kernels/scalar.h"

namespace mivo {
namespace kernels {
namespace reference {

void depthRow(const DepthView& depth, int y, int first, int width, float lowest, float highest,
              float* meters) {
  const std::ptrdiff_t row = y * depth.stride;
  for (int x = first; x < width; ++x) {
    const float z = depth.meters != nullptr ? depth.meters[row + x]
                                            : static_cast<float>(depth.steps[row + x]) * depth.unit;
    meters[x] = z >= lowest && z <= highest ? z : 0.0F;
  }
}

void reduceDepthRow(const DepthRows& fine, int width, float ratio, int first, float* coarse) {
  const int coarse_width = (width + 1) / 2;
  for (int x = first; x < coarse_width; ++x) {
    const float center = fine.row[fine.middle][2 * x];
    float sum = 0.0F;
    float count = 0.0F;
    for (int r = 0; r < fine.count && center > 0.0F; ++r) {
      for (int u = std::max(0, 2 * x - 1); u <= std::min(width - 1, 2 * x + 1); ++u) {
        if (std::abs(fine.row[r][u] - center) <= ratio * center) {
          sum += fine.row[r][u];
          count += 1.0F;
        }
      }
    }
    coarse[x] = center > 0.0F ? sum / count : 0.0F;
  }
}

void keepSmooth(const float* const depth[3], int width, float edge_ratio, int first,
                std::uint8_t* candidates) {
  for (int x = first; x + 1 < width; ++x) {
    float lowest = depth[1][x];
    float highest = depth[1][x];
    for (int r = 0; r < 3; ++r) {
      for (int u = x - 1; u <= x + 1; ++u) {
        lowest = std::min(lowest, depth[r][u]);
        highest = std::max(highest, depth[r][u]);
      }
    }
    if (!(lowest > 0.0F && highest - lowest <= edge_ratio * depth[1][x])) candidates[x] = 0;
  }
}

}  // namespace reference
}  // namespace kernels
}  // namespace mivo
