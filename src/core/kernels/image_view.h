// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace mivo {
namespace kernels {

/// Rows of gray levels, `stride` values apart: floats, or bytes where `data` is null.
struct ImageView {
  const float* data;
  const unsigned char* bytes;
  std::ptrdiff_t stride;
  int width;
  int height;
};

/// Rows of pairs (local mean, local deviation), `stride` floats apart. Pixel (u, v) of the image
/// lies at (u / 4, v / 4), and the pixels right of it and below it exist.
struct ContrastView {
  const float* pairs;
  std::ptrdiff_t stride;
  float constant;  ///< gray levels, is added to the deviation
};

/// Rows of readings: meters, or steps of `unit` meters where `meters` is null. What is not within
/// (0, kMaxReading) is no reading.
struct DepthView {
  const float* meters;
  const std::uint16_t* steps;
  std::ptrdiff_t stride;
  float unit;
};
constexpr float kMaxReading = 1e4F;

/// See Kernels::normalizeImage, gray levels.
struct NormalizeParameters {
  float constant;
  float middle;
  float gain;
  float white;
};

}  // namespace kernels
}  // namespace mivo
