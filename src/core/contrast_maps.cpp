// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/contrast_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mivo {
namespace {

constexpr int kWindow = 5;              // pixels of the map: 20 of the level
constexpr double kContrastShare = 0.1;  // constant as a share of the frame's own contrast
constexpr double kMinConstant = 0.2;    // grey levels
// A Gaussian reduction leaves about this much of white noise from level to level.
constexpr double kNoiseReduction = 0.3;
// The normalised image of a natural scene spans about +-2: 55 grey levels each.
constexpr float kMiddle = 128.0F;
constexpr float kGreyLevels = 55.0F;
constexpr float kWhite = 255.0F;

float bilinearAt(const cv::Mat& map, float u, float v) {
  const float cu = std::min(u, static_cast<float>(map.cols - 1));
  const float cv = std::min(v, static_cast<float>(map.rows - 1));
  const int x = std::min(static_cast<int>(cu), std::max(0, map.cols - 2));
  const int y = std::min(static_cast<int>(cv), std::max(0, map.rows - 2));
  const int x1 = std::min(x + 1, map.cols - 1);
  const int y1 = std::min(y + 1, map.rows - 1);
  const float du = cu - static_cast<float>(x);
  const float dv = cv - static_cast<float>(y);
  const auto* upper = map.ptr<float>(y);
  const auto* lower = map.ptr<float>(y1);
  const float top = upper[x] + du * (upper[x1] - upper[x]);
  const float low = lower[x] + du * (lower[x1] - lower[x]);
  return top + dv * (low - top);
}

/// Noise from second differences along every fourth row: texture has few of them, noise everywhere.
double estimateNoise(const cv::Mat& image) {
  constexpr int kRowStep = 4;
  constexpr int kSteps = 1024;  // of a quarter grey level
  std::array<int, kSteps> counts{};
  int total = 0;
  for (int y = 0; y < image.rows; y += kRowStep) {
    const auto* row = image.ptr<float>(y);
    for (int x = 1; x + 1 < image.cols; ++x) {
      const float difference = std::abs(2.0F * row[x] - row[x - 1] - row[x + 1]);
      ++counts[static_cast<std::size_t>(std::min(kSteps - 1, static_cast<int>(difference * 4.0F)))];
      ++total;
    }
  }
  int index = 0;
  for (int below = counts[0]; 2 * below < total && index + 1 < kSteps;) {
    below += counts[static_cast<std::size_t>(++index)];
  }
  const double median = 0.25 * (index + 0.5);
  return 1.4826 * median / std::sqrt(6.0);
}

}  // namespace

void ContrastMaps::build(const ImagePyramid& pyramid, int num_levels) {
  maps_.resize(static_cast<std::size_t>(num_levels));
  noise_ = estimateNoise(pyramid.level(0));
  double noise = noise_;
  for (int l = 0; l < num_levels; ++l) {
    ContrastMap& map = maps_[static_cast<std::size_t>(l)];
    const cv::Mat& reduced = pyramid.level(l + 2);
    const cv::Size window(kWindow, kWindow);
    cv::boxFilter(reduced, map.mean, CV_32F, window, cv::Point(-1, -1), true,
                  cv::BORDER_REFLECT_101);
    cv::sqrBoxFilter(reduced, square_, CV_32F, window, cv::Point(-1, -1), true,
                     cv::BORDER_REFLECT_101);
    map.deviation.create(reduced.size(), CV_32FC1);
    double sum = 0.0;
    for (int y = 0; y < reduced.rows; ++y) {
      const auto* mean = map.mean.ptr<float>(y);
      const auto* square = square_.ptr<float>(y);
      auto* deviation = map.deviation.ptr<float>(y);
      for (int x = 0; x < reduced.cols; ++x) {
        const float variance = std::max(0.0F, square[x] - mean[x] * mean[x]);
        sum += static_cast<double>(variance);
        deviation[x] = std::sqrt(variance);
      }
    }
    const double contrast = std::sqrt(sum / static_cast<double>(reduced.total()));
    if (l <= 1) contrast_ = contrast;
    map.constant = static_cast<float>(std::max({kContrastShare * contrast, noise, kMinConstant}));
    noise *= kNoiseReduction;
  }
}

float localContrast(const ContrastMap& map, int x, int y) {
  return bilinearAt(map.deviation, 0.25F * static_cast<float>(x), 0.25F * static_cast<float>(y)) +
         map.constant;
}

float normalisedIntensity(const cv::Mat& image, const ContrastMap& map, int x, int y) {
  const float mean =
      bilinearAt(map.mean, 0.25F * static_cast<float>(x), 0.25F * static_cast<float>(y));
  return (image.at<float>(y, x) - mean) / localContrast(map, x, y);
}

void normaliseImage(const cv::Mat& image, const ContrastMap& map, cv::Mat& normalised) {
  normalised.create(image.size(), CV_32FC1);
  for (int y = 0; y < image.rows; ++y) {
    auto* row = normalised.ptr<float>(y);
    for (int x = 0; x < image.cols; ++x) {
      const float grey = kMiddle + kGreyLevels * normalisedIntensity(image, map, x, y);
      row[x] = std::min(std::max(grey, 0.0F), kWhite);
    }
  }
}

}  // namespace mivo
