// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "mivo/core/se3.h"

// Random numbers for tests: seeded, and the same on every platform (the distributions of the
// standard library are not). Nor is the order in which arguments are evaluated: never draw two
// numbers in one call.

namespace mivo::testing {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [low, high).
  double uniform(double low, double high) {
    constexpr double kScale = 1.0 / 9007199254740992.0;  // 2^-53
    return low + (high - low) * kScale * static_cast<double>(engine_() >> 11U);
  }

  /// Standard normal: the sum of twelve uniform numbers is close enough and needs no logarithm.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform(0.0, 1.0);
    return sum;
  }

  /// Uniform on the unit sphere.
  Eigen::Vector3d direction() {
    while (true) {
      const double z = uniform(-1.0, 1.0);
      const double y = uniform(-1.0, 1.0);
      const double x = uniform(-1.0, 1.0);
      const Eigen::Vector3d v(x, y, z);
      const double square = v.squaredNorm();
      if (square > 0.01 && square <= 1.0) return v / std::sqrt(square);
    }
  }

  /// Increment of the given lengths in random directions: m, rad.
  Vector6 increment(double translation, double rotation) {
    Vector6 d;
    d << translation * direction(), rotation * direction();
    return d;
  }

  Eigen::Isometry3d pose(double translation, double rotation) {
    return retract(increment(translation, rotation));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace mivo::testing
