// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "synthetic/pixel_noise.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

constexpr int kLength = 2048;  // texels across the stripes
// Along them: as many as the levels need that are looked up from afar.
constexpr int kBreadth = 32;
constexpr double kMetersPerTexel = 0.0025;
constexpr int kNarrowest = 8;  // texels
constexpr int kWidest = 60;
constexpr float kDarkest = 0.12F;
constexpr float kBrightest = 0.75F;
// Pigment within a stripe: amplitude ~ 1 / frequency.
constexpr int kLowestFrequency = 20;  // cycles per texture
constexpr int kHighestFrequency = 400;
constexpr float kPigment = 0.6F;  // of the stripe's brightness, at one cycle

float pigment(int x, std::uint64_t seed) {
  float sum = 0.0F;
  for (int k = kLowestFrequency; k <= kHighestFrequency; ++k) {
    const float turns = static_cast<float>((k * x) % kLength) / kLength +
                        uniformFrom(hashOf(seed, 0x9163, static_cast<std::uint64_t>(k)));
    sum += std::sin(6.2831853F * turns) / static_cast<float>(k);
  }
  return kPigment * sum;
}

std::vector<float> stripes(std::uint64_t seed) {
  std::vector<float> tones(kLength);
  std::uint64_t stripe = 0;
  for (int x = 0; x < kLength; ++stripe) {
    const std::uint64_t bits = hashOf(seed, 0x57817, stripe);
    const int end = x + kNarrowest + static_cast<int>((kWidest - kNarrowest) * uniformFrom(bits));
    const float tone = kDarkest + (kBrightest - kDarkest) * uniformFrom(mixBits(bits));
    for (; x < end && x < kLength; ++x) {
      tones[static_cast<std::size_t>(x)] = tone * (1.0F + pigment(x, seed));
    }
  }
  return tones;
}

}  // namespace

Texture stripesTexture(bool along_y, std::uint64_t seed) {
  const std::vector<float> tones = stripes(seed);
  cv::Mat texels(kBreadth, kLength, CV_32FC4);
  for (int x = 0; x < kLength; ++x) {
    const float tone = tones[static_cast<std::size_t>(x)];
    texels.col(x).setTo(cv::Scalar(tone, tone, tone, 0.0));
  }
  return Texture(along_y ? cv::Mat(texels.t()) : texels, kMetersPerTexel);
}

}  // namespace mivo
