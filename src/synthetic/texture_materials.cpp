// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "synthetic/pixel_noise.h"
#include "synthetic/spectral_noise.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

constexpr float kMinReflectance = 0.015F;
constexpr float kMaxReflectance = 0.92F;

cv::Vec4f texel(const Reflectance& color, float brightness, float highlight) {
  cv::Vec4f value(0.0F, 0.0F, 0.0F, highlight);
  for (int c = 0; c < 3; ++c) {
    value[c] = std::clamp(color[c] * brightness, kMinReflectance, kMaxReflectance);
  }
  return value;
}

template <typename Function>
Texture compose(int size, double meters_per_texel, const Function& value) {
  cv::Mat texels(size, size, CV_32FC4);
  for (int y = 0; y < size; ++y) {
    auto* row = texels.ptr<cv::Vec4f>(y);
    for (int x = 0; x < size; ++x) {
      row[x] = value(x, y);
    }
  }
  return Texture(texels, meters_per_texel);
}

// Position in a running bond of `columns` x `rows` pieces with texels `size`.
struct BondCell {
  int column;
  int row;
  float u;  // 0..1 within the piece
  float v;
};

BondCell bondCell(int x, int y, int size, int columns, int rows, const std::vector<float>& shifts) {
  const float row_position = static_cast<float>(y) * rows / size;
  const int row = static_cast<int>(row_position);
  float column_position =
      static_cast<float>(x) * columns / size + shifts[static_cast<std::size_t>(row)];
  column_position -= columns * std::floor(column_position / columns);
  const int column = std::min(static_cast<int>(column_position), columns - 1);
  return {column, row, column_position - column, row_position - row};
}

// 1 inside, falling to 0 over the joint of the given width (fractions of the piece).
float insidePiece(const BondCell& cell, float joint_u, float joint_v) {
  const float du = std::min(cell.u, 1.0F - cell.u) / joint_u;
  const float dv = std::min(cell.v, 1.0F - cell.v) / joint_v;
  return std::clamp(2.0F * std::min(du, dv) - 0.5F, 0.0F, 1.0F);
}

}  // namespace

Texture plasterTexture(const Reflectance& color, double contrast, std::uint64_t seed) {
  constexpr int kSize = 1024;
  const cv::Mat fine = spectralNoise(kSize, {1.05, 1.0, 2.0}, seed);
  const cv::Mat grain = spectralNoise(kSize, {0.5, 1.0, 1.0}, seed + 1);
  return compose(kSize, 0.0025, [&](int x, int y) {
    const float brightness = 1.0F + static_cast<float>(contrast) *
                                        (fine.at<float>(y, x) + 0.25F * grain.at<float>(y, x));
    return texel(color, brightness, 0.0F);
  });
}

Texture brickTexture(std::uint64_t seed) {
  constexpr int kSize = 1024;
  constexpr int kColumns = 10;  // 21 cm
  constexpr int kRows = 28;     // 7.5 cm
  const cv::Mat fine = spectralNoise(kSize, {0.9, 1.0, 4.0}, seed);
  const cv::Mat ragged = spectralNoise(kSize, {1.2, 1.0, 30.0}, seed + 1);
  const Reflectance mortar(0.42F, 0.46F, 0.48F);
  const Reflectance red(0.13F, 0.18F, 0.38F);
  const Reflectance pale(0.24F, 0.32F, 0.46F);
  std::vector<float> shifts;
  for (int row = 0; row < kRows; ++row) {
    shifts.push_back(0.5F * (row % 2) + 0.1F * uniformFrom(hashOf(seed, 77, row)));
  }
  return compose(kSize, 0.00205, [&](int x, int y) {
    const BondCell cell = bondCell(x, y, kSize, kColumns, kRows, shifts);
    const std::uint64_t bits = hashOf(seed, cell.row, cell.column);
    const float mix = uniformFrom(bits);
    const float shade = 0.65F + 0.7F * uniformFrom(mixBits(bits));
    const float inside =
        std::clamp(insidePiece(cell, 0.055F, 0.16F) + 0.12F * ragged.at<float>(y, x), 0.0F, 1.0F);
    const float rough = 1.0F + 0.16F * fine.at<float>(y, x);
    const Reflectance brick = (mix * red + (1.0F - mix) * pale) * shade;
    return texel(inside * brick + (1.0F - inside) * mortar, rough, 0.0F);
  });
}

Texture plankTexture(std::uint64_t seed) {
  constexpr int kSize = 1024;
  constexpr int kColumns = 2;  // 1.2 m
  constexpr int kRows = 20;    // 12 cm
  const cv::Mat grain = spectralNoise(kSize, {1.0, 24.0, 3.0}, seed);
  const cv::Mat cloud = spectralNoise(kSize, {1.5, 4.0, 2.0}, seed + 1);
  const Reflectance wood(0.10F, 0.20F, 0.34F);
  std::vector<float> shifts;
  for (int row = 0; row < kRows; ++row) {
    shifts.push_back(kColumns * uniformFrom(hashOf(seed, 78, row)));
  }
  return compose(kSize, 0.00235, [&](int x, int y) {
    const BondCell cell = bondCell(x, y, kSize, kColumns, kRows, shifts);
    const std::uint64_t bits = hashOf(seed, cell.row, cell.column);
    const float tone = 0.65F + 0.75F * uniformFrom(bits);
    // Each board is cut from another part of the tree.
    const int dx = static_cast<int>(mixBits(bits) % kSize);
    const int dy = static_cast<int>(mixBits(bits + 1) % kSize);
    const float rings = grain.at<float>((y + dy) % kSize, (x + dx) % kSize);
    const float veins = std::sin(7.0F * cloud.at<float>((y + dy) % kSize, (x + dx) % kSize));
    const float inside = insidePiece(cell, 0.004F, 0.05F);
    const float brightness = tone * (1.0F + 0.17F * rings + 0.10F * veins) * (0.3F + 0.7F * inside);
    return texel(wood, brightness, 0.35F * inside);
  });
}

Texture grainTexture(const Reflectance& color, std::uint64_t seed) {
  constexpr int kSize = 512;
  const cv::Mat grain = spectralNoise(kSize, {0.9, 40.0, 3.0}, seed);
  const cv::Mat cloud = spectralNoise(kSize, {1.7, 6.0, 1.0}, seed + 1);
  return compose(kSize, 0.003, [&](int x, int y) {
    const float rings = std::sin(9.0F * cloud.at<float>(y, x));
    return texel(color, 1.0F + 0.16F * grain.at<float>(y, x) + 0.16F * rings, 0.5F);
  });
}

Texture wovenTexture(const Reflectance& color, const Reflectance& second, std::uint64_t seed) {
  constexpr int kSize = 512;
  const cv::Mat fine = spectralNoise(kSize, {0.6, 1.0, 2.0}, seed);
  const cv::Mat cloud = spectralNoise(kSize, {1.3, 1.0, 2.0}, seed + 1);
  return compose(kSize, 0.0025, [&](int x, int y) {
    // Threads of 4 texels cross over and under; some are of the second color.
    const std::uint64_t warp = hashOf(seed, 1, x / 4);
    const std::uint64_t weft = hashOf(seed, 2, y / 4);
    const bool on_top = ((x / 4) + (y / 4)) % 2 == 0;
    const float mix = uniformFrom(on_top ? warp : weft) < 0.3F ? 1.0F : 0.0F;
    const float round = 0.85F + 0.15F * (on_top ? (x % 4 == 0 || x % 4 == 3 ? 0.0F : 1.0F)
                                                : (y % 4 == 0 || y % 4 == 3 ? 0.0F : 1.0F));
    const float brightness =
        round * (1.0F + 0.15F * fine.at<float>(y, x) + 0.17F * cloud.at<float>(y, x));
    return texel(mix * second + (1.0F - mix) * color, brightness, 0.0F);
  });
}

Texture stoneTexture(const Reflectance& color, std::uint64_t seed) {
  constexpr int kSize = 512;
  const cv::Mat cloud = spectralNoise(kSize, {1.2, 1.0, 1.0}, seed);
  const cv::Mat folds = spectralNoise(kSize, {1.5, 2.0, 2.0}, seed + 1);
  return compose(kSize, 0.002, [&](int x, int y) {
    const float vein =
        std::exp(-40.0F * std::abs(folds.at<float>(y, x)) * std::abs(folds.at<float>(y, x)));
    return texel(color, 1.0F + 0.14F * cloud.at<float>(y, x) - 0.45F * vein, 0.9F);
  });
}

Texture terrazzoTexture(std::uint64_t seed) {
  constexpr int kSize = 1024;
  const cv::Mat cloud = spectralNoise(kSize, {1.2, 1.0, 1.0}, seed);
  const cv::Mat chips = spectralNoise(kSize, {1.6, 1.0, 90.0}, seed + 1);
  const cv::Mat tints = spectralNoise(kSize, {1.6, 1.0, 40.0}, seed + 2);
  return compose(kSize, 0.0025, [&](int x, int y) {
    const float chip = std::clamp(4.0F * (std::abs(chips.at<float>(y, x)) - 0.9F), 0.0F, 1.0F);
    const float tint = 0.35F * tints.at<float>(y, x) * chip;
    const Reflectance color(0.30F - 0.08F * tint, 0.33F, 0.35F + 0.10F * tint);
    return texel(color, 1.0F + tint + 0.07F * cloud.at<float>(y, x), 0.45F);
  });
}

Texture cardboardTexture(std::uint64_t seed) {
  constexpr int kSize = 256;
  const cv::Mat fibers = spectralNoise(kSize, {0.8, 5.0, 1.0}, seed);
  const cv::Mat cloud = spectralNoise(kSize, {1.3, 1.0, 1.0}, seed + 1);
  const Reflectance brown(0.17F, 0.29F, 0.42F);
  return compose(kSize, 0.0025, [&](int x, int y) {
    return texel(brown, 1.0F + 0.07F * fibers.at<float>(y, x) + 0.12F * cloud.at<float>(y, x),
                 0.0F);
  });
}

Texture plainTexture(const Reflectance& color) {
  return compose(4, 0.1, [&](int, int) { return texel(color, 1.0F, 1.0F); });
}

}  // namespace mivo
