// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace mivo {
namespace kernels {

/// Rows of gray levels, `stride` values apart: floats, or bytes if `data` is null.
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
  float constant;  ///< added to the deviation, gray levels
};

/// Rows of depth readings: in meters, or in steps of `unit` meters if `meters` is null. Valid
/// readings are within (0, kMaxReading).
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
