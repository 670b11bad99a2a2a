// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/imager.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "mivo/core/error.h"
#include "synthetic/pixel_noise.h"

namespace mivo {
namespace {

constexpr int kTableSteps = 65535;

}  // namespace

Imager::Imager(const ImagerOptions& options) : options_(options) {
  if (!(options.full_well > 0.0) || !(options.read_noise >= 0.0) || !(options.vignetting >= 0.0) ||
      !(options.vignetting < 1.0)) {
    throw Error("sensor: full well must be positive, read noise not negative, vignetting in 0..1");
  }
  table_.resize(kTableSteps + 1);
  for (int k = 0; k <= kTableSteps; ++k) {
    table_[static_cast<std::size_t>(k)] =
        static_cast<unsigned char>(std::lround(encode(static_cast<double>(k) / kTableSteps)));
  }
}

double Imager::linear(double value) const {
  const double v = std::clamp(value / 255.0, 0.0, 1.0);
  if (options_.transfer == Transfer::kLinear) {
    return v;
  }
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
}

double Imager::encode(double linear) const {
  const double l = std::clamp(linear, 0.0, 1.0);
  if (options_.transfer == Transfer::kLinear) {
    return 255.0 * l;
  }
  return 255.0 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055);
}

cv::Mat Imager::expose(const cv::Mat& light, double scale, double gain, std::uint64_t seed) const {
  if (light.depth() != CV_32F || (light.channels() != 1 && light.channels() != 3)) {
    throw Error("sensor: expected an image of 1 or 3 channels of 32-bit floats");
  }
  const int channels = light.channels();
  cv::Mat image(light.size(), CV_8UC(channels));
  const auto noise_unit = static_cast<float>(gain / options_.full_well);
  const auto read_variance = static_cast<float>(options_.read_noise * options_.read_noise);
  const float center_x = 0.5F * static_cast<float>(light.cols - 1);
  const float center_y = 0.5F * static_cast<float>(light.rows - 1);
  const float corner2 = std::max(center_x * center_x + center_y * center_y, 1.0F);
  const auto loss = static_cast<float>(options_.vignetting) / corner2;
  const float* normal = gaussianTable();
  cv::parallel_for_(cv::Range(0, light.rows), [&](const cv::Range& range) {
    for (int y = range.start; y < range.end; ++y) {
      const auto* in = light.ptr<float>(y);
      auto* out = image.ptr<unsigned char>(y);
      const float dy2 = (static_cast<float>(y) - center_y) * (static_cast<float>(y) - center_y);
      for (int x = 0; x < light.cols; ++x) {
        const float dx = static_cast<float>(x) - center_x;
        const float pixel_scale = static_cast<float>(scale) * (1.0F - loss * (dx * dx + dy2));
        const std::uint64_t bits =
            options_.noise ? hashOf(seed, static_cast<std::uint64_t>(y * light.cols + x)) : 0;
        for (int c = 0; c < channels; ++c) {
          float signal = std::min(pixel_scale * *in++, 4.0F);
          if (options_.noise) {
            // Electrons n = signal / noise_unit; beyond saturation the noise no longer matters.
            const float deviation =
                std::sqrt(std::max(signal, 0.0F) / noise_unit + read_variance) * noise_unit;
            signal += deviation * normal[(bits >> (16 * c)) & 0xffffU];
          }
          const float clipped = std::clamp(signal, 0.0F, 1.0F);
          *out++ = table_[static_cast<std::size_t>(clipped * kTableSteps + 0.5F)];
        }
      }
    }
  });
  return image;
}

double meanGray(const cv::Mat& image) {
  const cv::Scalar mean = cv::mean(image);
  double sum = 0.0;
  for (int c = 0; c < image.channels(); ++c) {
    sum += mean[c];
  }
  return sum / image.channels();
}

}  // namespace mivo
