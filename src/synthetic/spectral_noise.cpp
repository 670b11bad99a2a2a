// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/spectral_noise.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "synthetic/pixel_noise.h"

namespace mivo {

// White noise, filtered in the frequency domain: the result is real and periodic by construction.
cv::Mat spectralNoise(int size, const Spectrum& spectrum, std::uint64_t seed) {
  cv::Mat white(size, size, CV_32FC1);
  for (int y = 0; y < size; ++y) {
    auto* row = white.ptr<float>(y);
    for (int x = 0; x < size; ++x) {
      row[x] =
          gaussianFrom(hashOf(seed, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x)));
    }
  }
  cv::Mat transformed;
  cv::dft(white, transformed, cv::DFT_COMPLEX_OUTPUT);
  const auto lowest = static_cast<float>(spectrum.lowest_frequency);
  const auto half_exponent = static_cast<float>(-0.5 * spectrum.exponent);
  for (int y = 0; y < size; ++y) {
    auto* row = transformed.ptr<cv::Vec2f>(y);
    const auto fy = static_cast<float>((y < size / 2 ? y : y - size) / std::sqrt(spectrum.stretch));
    for (int x = 0; x < size; ++x) {
      const auto fx =
          static_cast<float>((x < size / 2 ? x : x - size) * std::sqrt(spectrum.stretch));
      const float squared = std::max(fx * fx + fy * fy, lowest * lowest);
      row[x] *= std::pow(squared, half_exponent);
    }
  }
  transformed.at<cv::Vec2f>(0, 0) = cv::Vec2f(0.0F, 0.0F);
  cv::Mat noise;
  cv::dft(transformed, noise, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(noise, mean, deviation);
  noise *= 1.0 / deviation[0];
  return noise;
}

}  // namespace mivo
