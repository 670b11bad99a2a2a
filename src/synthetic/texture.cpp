// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// std::floor is a call into the library where the processor's baseline lacks the instruction.
int floorToInt(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (x < static_cast<float>(truncated) ? 1 : 0);
}

bool isPowerOfTwo(int n) {
  return n > 0 && (n & (n - 1)) == 0;
}

}  // namespace

Texture::Texture(const cv::Mat& texels, double meters_per_texel)
    : meters_per_texel_(static_cast<float>(meters_per_texel)) {
  if (texels.type() != CV_32FC4 || !isPowerOfTwo(texels.cols) || !isPowerOfTwo(texels.rows)) {
    throw Error("texture: expected CV_32FC4 with sizes that are powers of two");
  }
  Level level{texels.cols, texels.rows, 1.0F, {}};
  level.texels.reserve(texels.total());
  for (int y = 0; y < texels.rows; ++y) {
    const auto* row = texels.ptr<cv::Vec4f>(y);
    for (int x = 0; x < texels.cols; ++x) {
      level.texels.emplace_back(row[x][0], row[x][1], row[x][2], row[x][3]);
    }
  }
  levels_.push_back(std::move(level));
  // Means of 2 x 2: texel (x, y) of a level is centered on (2x + 0.5, 2y + 0.5) of the finer one.
  while (levels_.back().width > 1 && levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{fine.width / 2, fine.height / 2, fine.scale * 0.5F, {}};
    coarse.texels.reserve(fine.texels.size() / 4);
    for (int y = 0; y < coarse.height; ++y) {
      const auto* upper = &fine.texels[static_cast<std::size_t>(2 * y * fine.width)];
      const auto* lower = upper + fine.width;
      for (int x = 0; x < coarse.width; ++x) {
        coarse.texels.emplace_back(
            0.25F * (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1]));
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

Eigen::Array4f Texture::bilinear(const Level& level, float x, float y) {
  const float level_x = (x + 0.5F) * level.scale - 0.5F;
  const float level_y = (y + 0.5F) * level.scale - 0.5F;
  const int floor_x = floorToInt(level_x);
  const int floor_y = floorToInt(level_y);
  const float ax = level_x - static_cast<float>(floor_x);
  const float ay = level_y - static_cast<float>(floor_y);
  const int x0 = floor_x & (level.width - 1);
  const int y0 = floor_y & (level.height - 1);
  const int x1 = (x0 + 1) & (level.width - 1);
  const int y1 = (y0 + 1) & (level.height - 1);
  const Eigen::Array4f* upper = level.texels.data() + static_cast<std::ptrdiff_t>(y0) * level.width;
  const Eigen::Array4f* lower = level.texels.data() + static_cast<std::ptrdiff_t>(y1) * level.width;
  const Eigen::Array4f top = upper[x0] + ax * (upper[x1] - upper[x0]);
  const Eigen::Array4f bottom = lower[x0] + ax * (lower[x1] - lower[x0]);
  return top + ay * (bottom - top);
}

Eigen::Array4f Texture::sample(float x, float y, float footprint) const {
  const float last = static_cast<float>(levels_.size() - 1);
  const float lod = std::clamp(std::log2(std::max(footprint, 1.0F)), 0.0F, last);
  const int fine = static_cast<int>(lod);
  const float weight = lod - static_cast<float>(fine);
  const Eigen::Array4f value = bilinear(levels_[static_cast<std::size_t>(fine)], x, y);
  if (weight < 1e-3F) {
    return value;
  }
  return value + weight * (bilinear(levels_[static_cast<std::size_t>(fine + 1)], x, y) - value);
}

}  // namespace mivo
