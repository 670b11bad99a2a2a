// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace mivo {

/// Cubic B-spline as Parzen window (section III-A). A value s = k + t, 0 <= t < 1, spreads over the
/// bins k-1, k, k+1, k+2 with weights that sum to one.
constexpr int kSplineSupport = 4;
using SplineWeights = std::array<float, kSplineSupport>;

inline SplineWeights splineWeights(float t) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  return {(1.0F - 3.0F * t + 3.0F * t2 - t3) / 6.0F, (4.0F - 6.0F * t2 + 3.0F * t3) / 6.0F,
          (1.0F + 3.0F * t + 3.0F * t2 - 3.0F * t3) / 6.0F, t3 / 6.0F};
}

/// Derivatives of the weights with respect to s.
inline SplineWeights splineDerivatives(float t) {
  const float t2 = t * t;
  return {(-3.0F + 6.0F * t - 3.0F * t2) / 6.0F, (-12.0F * t + 9.0F * t2) / 6.0F,
          (3.0F + 6.0F * t - 9.0F * t2) / 6.0F, 3.0F * t2 / 6.0F};
}

inline SplineWeights splineSecondDerivatives(float t) {
  return {1.0F - t, -2.0F + 3.0F * t, 1.0F - 3.0F * t, t};
}

}  // namespace mivo
