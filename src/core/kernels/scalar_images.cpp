// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/kernels/scalar.h"

namespace mivo {
namespace kernels {
namespace reference {
namespace {

constexpr int kRadius = 2;  // of the Gaussian and of the window of the contrast map

/// Index mirrored at the first and the last entry, without repeating them (OpenCV's REFLECT_101).
int mirrored(int i, int n) {
  if (n == 1) return 0;
  while (i < 0 || i >= n) i = i < 0 ? -i : 2 * (n - 1) - i;
  return i;
}

float valueAt(const ImageView& image, int x, int y) {
  const std::ptrdiff_t offset = y * image.stride + x;
  return image.data != nullptr ? image.data[offset] : static_cast<float>(image.bytes[offset]);
}

struct Gradient {
  float x;
  float y;
};

/// Twice the central differences.
Gradient differencesAt(const ImageView& image, int x, int y) {
  return {valueAt(image, x + 1, y) - valueAt(image, x - 1, y),
          valueAt(image, x, y + 1) - valueAt(image, x, y - 1)};
}

bool isMaximal(const ImageView& image, int x, int y, const float* const squared[3]) {
  constexpr float kTan22_5 = 0.41421356F;
  const Gradient g = differencesAt(image, x, y);
  const float ax = std::abs(g.x);
  const float ay = std::abs(g.y);
  int dx = 1;
  int dy = 0;
  if (ay > ax * kTan22_5) {
    dy = g.x * g.y >= 0.0F ? 1 : -1;
    if (ax <= ay * kTan22_5) {
      dx = 0;
      dy = 1;
    }
  }
  const float here = squared[1][x];
  const float first = squared[1 - dy][x - dx];
  const float second = squared[1 + dy][x + dx];
  return dy < 0 ? here >= second && here > first : here >= first && here > second;
}

}  // namespace

void reduce(const ImageView& fine, float* coarse, std::ptrdiff_t coarse_stride, float* scratch) {
  constexpr float kWeights[2 * kRadius + 1] = {1.0F, 4.0F, 6.0F, 4.0F, 1.0F};
  constexpr float kNorm = 1.0F / 256.0F;
  for (int y = 0; 2 * y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      float sum = 0.0F;
      for (int k = -kRadius; k <= kRadius; ++k) {
        sum += kWeights[k + kRadius] * valueAt(fine, x, mirrored(2 * y + k, fine.height));
      }
      scratch[x] = sum;
    }
    for (int x = 0; 2 * x < fine.width; ++x) {
      float sum = 0.0F;
      for (int k = -kRadius; k <= kRadius; ++k) {
        sum += kWeights[k + kRadius] * scratch[mirrored(2 * x + k, fine.width)];
      }
      coarse[y * coarse_stride + x] = kNorm * sum;
    }
  }
}

void smooth(const ImageView& image, std::uint8_t largest, std::uint8_t* smoothed,
            std::ptrdiff_t smoothed_stride, float* /*scratch*/) {
  constexpr int kWeights[3] = {1, 2, 1};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      int sum = 0;
      std::uint8_t maximum = 0;
      for (int j = -1; j <= 1; ++j) {
        const std::uint8_t* row = image.bytes + mirrored(y + j, image.height) * image.stride;
        for (int i = -1; i <= 1; ++i) {
          const std::uint8_t value = row[mirrored(x + i, image.width)];
          sum += kWeights[j + 1] * kWeights[i + 1] * value;
          maximum = std::max(maximum, value);
        }
      }
      smoothed[y * smoothed_stride + x] = maximum > largest
                                              ? image.bytes[y * image.stride + x]
                                              : static_cast<std::uint8_t>((sum + 8) / 16);
    }
  }
}

double contrastMap(const ImageView& image, float* pairs, std::ptrdiff_t pairs_stride,
                   float* scratch) {
  constexpr float kInverseArea = 1.0F / ((2 * kRadius + 1) * (2 * kRadius + 1));
  float* sums = scratch;
  float* squares = scratch + image.width;
  double variances = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      sums[x] = 0.0F;
      squares[x] = 0.0F;
      for (int k = -kRadius; k <= kRadius; ++k) {
        const float value = valueAt(image, x, mirrored(y + k, image.height));
        sums[x] += value;
        squares[x] += value * value;
      }
    }
    for (int x = 0; x < image.width; ++x) {
      float sum = 0.0F;
      float square = 0.0F;
      for (int k = -kRadius; k <= kRadius; ++k) {
        sum += sums[mirrored(x + k, image.width)];
        square += squares[mirrored(x + k, image.width)];
      }
      const float mean = kInverseArea * sum;
      const float variance = std::max(0.0F, kInverseArea * square - mean * mean);
      variances += static_cast<double>(variance);
      float* pair = pairs + y * pairs_stride + 2 * x;
      pair[0] = mean;
      pair[1] = std::sqrt(variance);
    }
  }
  return variances;
}

void normalizeImage(const ImageView& image, const ContrastView& contrast,
                    const NormalizeParameters& p, float* normalized,
                    std::ptrdiff_t normalized_stride, float* /*scratch*/) {
  const auto between = [](float a, float b, int quarters) {
    return a + 0.25F * static_cast<float>(quarters) * (b - a);
  };
  for (int y = 0; y < image.height; ++y) {
    const float* upper = contrast.pairs + y / 4 * contrast.stride;
    const float* lower = upper + contrast.stride;
    for (int x = 0; x < image.width; ++x) {
      const int left = x / 4 * 2;
      const auto at = [&](int i) {
        return between(between(upper[left + i], lower[left + i], y % 4),
                       between(upper[left + 2 + i], lower[left + 2 + i], y % 4), x % 4);
      };
      const float value = (valueAt(image, x, y) - at(0)) / (at(1) + p.constant);
      normalized[y * normalized_stride + x] =
          std::min(std::max(p.middle + p.gain * value, 0.0F), p.white);
    }
  }
}

void gradientRow(const ImageView& image, int y, float* squared) {
  squared[0] = 0.0F;
  gradientTail(image, y, 1, squared);
}

void gradientTail(const ImageView& image, int y, int first, float* squared) {
  for (int x = first; x + 1 < image.width; ++x) {
    const Gradient g = differencesAt(image, x, y);
    squared[x] = 0.25F * (g.x * g.x + g.y * g.y);
  }
  squared[image.width - 1] = 0.0F;
}

void maximaRow(const ImageView& image, int y, const float* const squared[3], float threshold,
               std::uint8_t* maximal) {
  maximaTail(image, y, squared, threshold, 0, maximal);
}

void maximaTail(const ImageView& image, int y, const float* const squared[3], float threshold,
                int first, std::uint8_t* maximal) {
  for (int x = first; x < image.width; ++x) {
    const float here = squared[1][x];
    const bool is_inside = x >= 2 && x + 2 < image.width;
    maximal[x] =
        is_inside && here > 0.0F && here >= threshold && isMaximal(image, x, y, squared) ? 1 : 0;
  }
}

}  // namespace reference
}  // namespace kernels
}  // namespace mivo
