// SPDX-License-Identifier: BSD-3-Clause
#include "core/images/contrast_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/execution/recycled.h"
#include "core/images/pixel_access.h"

namespace mivo {
namespace {

// The constant of the normalization is the largest of three values. First, a fraction of the
// frame's RMS contrast: it changes typical values by 10 % and suppresses flat regions.
constexpr double kContrastShare = 0.1;
// Second, gray levels: below the rounding of 8 bits (0.29), avoids division by zero.
constexpr double kMinConstant = 0.2;
// Third, the noise. A Gaussian reduction leaves about this fraction of it from level to level: 70 /
// 256 of white noise, more of correlated noise.
constexpr double kNoiseReduction = 0.3;
// Fraction of the noise on level 0 that remains after smoothing, 6/16.
constexpr double kNoiseSmoothed = 0.375;
// The normalized image of a natural scene spans about +-2: 55 gray levels each.
constexpr float kMiddle = 128.0F;
constexpr float kGrayLevels = 55.0F;
constexpr float kWhite = 255.0F;

/// One of the two values of a map, interpolated at a pixel of the level.
float interpolated(const ContrastMap& map, int x, int y, int channel) {
  const auto* upper = map.pairs.ptr<cv::Vec2f>(y / 4) + x / 4;
  const auto* lower = map.pairs.ptr<cv::Vec2f>(y / 4 + 1) + x / 4;
  const float du = 0.25F * static_cast<float>(x % 4);
  const float dv = 0.25F * static_cast<float>(y % 4);
  const float top = upper[0][channel] + du * (upper[1][channel] - upper[0][channel]);
  const float low = lower[0][channel] + du * (lower[1][channel] - lower[0][channel]);
  return top + dv * (low - top);
}

/// Repeats the last column and the last row.
void repeatEnds(cv::Mat& pairs) {
  const int columns = pairs.cols - 1;
  const int rows = pairs.rows - 1;
  for (int y = 0; y < rows; ++y) {
    auto* row = pairs.ptr<cv::Vec2f>(y);
    row[columns] = row[columns - 1];
  }
  std::copy(pairs.ptr<cv::Vec2f>(rows - 1), pairs.ptr<cv::Vec2f>(rows - 1) + columns + 1,
            pairs.ptr<cv::Vec2f>(rows));
}

/// Noise of an 8-bit image from second differences along some rows: texture has few large ones,
/// noise has them everywhere. The median is interpolated between integers.
double estimateNoise(const cv::Mat& image) {
  constexpr int kRowStep = 16;  // 30 rows of 640 pixels determine the median to 1 %
  constexpr int kLargest = 2 * 255;
  std::array<int, kLargest + 1> counts{};
  int total = 0;
  for (int y = 0; y < image.rows; y += kRowStep) {
    const auto* row = image.ptr<unsigned char>(y);
    for (int x = 1; x + 1 < image.cols; ++x) {
      ++counts[static_cast<std::size_t>(std::abs(2 * row[x] - row[x - 1] - row[x + 1]))];
    }
    total += std::max(0, image.cols - 2);
  }
  std::size_t median = 0;
  int below = 0;
  while (median < kLargest && 2 * (below + counts[median]) < total) below += counts[median++];
  // Values of one count are assumed to be uniform over the unit around it; zero has half a unit.
  const double share =
      counts[median] > 0 ? (0.5 * total - below) / static_cast<double>(counts[median]) : 0.0;
  const double exact = median == 0 ? 0.5 * share : static_cast<double>(median) - 0.5 + share;
  return 1.4826 * exact / std::sqrt(6.0);
}

}  // namespace

void ContrastMaps::build(const ImagePyramid& pyramid, int num_levels) {
  maps_.resize(static_cast<std::size_t>(num_levels));
  noise_ = estimateNoise(pyramid.level(0));
  double noise = noise_;
  for (int l = 0; l < num_levels; ++l) {
    ContrastMap& map = maps_[static_cast<std::size_t>(l)];
    const cv::Mat& reduced = pyramid.level(l + 2);
    map.pairs.create(reduced.rows + 1, reduced.cols + 1, CV_32FC2);
    scratch_.resize(kernels::imageScratch(reduced.cols));
    const double variances = kernels::active().contrastMap(
        view(reduced), map.pairs.ptr<float>(), static_cast<std::ptrdiff_t>(map.pairs.step1()),
        scratch_.data());
    repeatEnds(map.pairs);
    const double contrast = std::sqrt(variances / static_cast<double>(reduced.total()));
    map.constant = static_cast<float>(std::max(
        {kContrastShare * contrast, l == 0 ? kNoiseSmoothed * noise : noise, kMinConstant}));
    noise *= kNoiseReduction;
  }
}

kernels::ContrastView view(const ContrastMap& map) {
  return {map.pairs.ptr<float>(), static_cast<std::ptrdiff_t>(map.pairs.step1()), map.constant};
}

float localContrast(const ContrastMap& map, int x, int y) {
  return interpolated(map, x, y, 1) + map.constant;
}

float normalizedIntensity(const cv::Mat& image, const ContrastMap& map, int x, int y) {
  return (intensityAt(image, x, y) - interpolated(map, x, y, 0)) / localContrast(map, x, y);
}

void normalizeImage(const cv::Mat& image, const ContrastMap& map, cv::Mat& normalized) {
  normalized.create(image.size(), CV_32FC1);
  Recycled<std::vector<float>> scratch;
  scratch->resize(kernels::imageScratch(image.cols));
  kernels::active().normalizeImage(
      view(image), view(map), {map.constant, kMiddle, kGrayLevels, kWhite}, normalized.ptr<float>(),
      static_cast<std::ptrdiff_t>(normalized.step1()), scratch->data());
}

}  // namespace mivo
