// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/pixel_noise.h"

#include <array>
#include <cmath>

namespace mivo {
namespace {

constexpr int kTableSize = 65536;

// Newton's method on the distribution function. Going outwards from the median, the last quantile
// is a good start.
std::array<float, kTableSize> makeTable() {
  std::array<float, kTableSize> table{};
  const double sqrt_half = std::sqrt(0.5);
  const double density_factor = 1.0 / std::sqrt(2.0 * std::acos(-1.0));
  double x = 0.0;
  for (int k = kTableSize / 2; k < kTableSize; ++k) {
    const double upper_tail = 1.0 - (k + 0.5) / kTableSize;
    for (int iteration = 0; iteration < 8; ++iteration) {
      const double excess = 0.5 * std::erfc(x * sqrt_half) - upper_tail;
      x += excess / (density_factor * std::exp(-0.5 * x * x));
    }
    table[static_cast<std::size_t>(k)] = static_cast<float>(x);
    table[static_cast<std::size_t>(kTableSize - 1 - k)] = static_cast<float>(-x);
  }
  return table;
}

}  // namespace

const float* gaussianTable() {
  static const std::array<float, kTableSize> table = makeTable();
  return table.data();
}

}  // namespace mivo
