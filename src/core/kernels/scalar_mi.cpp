// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/kernels/scalar.h"
#include "core/terms/bspline.h"

namespace mivo {
namespace kernels {
namespace reference {

void binPositions(const float* value, std::size_t n, float low, float scale, float top,
                  std::int32_t* bin, float* fraction) {
  for (std::size_t i = 0; i < n; ++i) {
    const float wanted = (value[i] - low) * scale;
    const float position = std::min(std::max(wanted, 0.0F), top);
    bin[i] = static_cast<std::int32_t>(position);  // not negative, so truncating rounds down
    fraction[i] = position - static_cast<float>(bin[i]);
  }
}

void jointHistogram(const BinsView& reference, const BinsView& live, const float* visible,
                    std::size_t n, int side, float* /*scratch*/, double* sums) {
  for (std::size_t i = 0; i < n; ++i) {
    if (visible[i] == 0.0F) continue;
    const SplineWeights r = splineWeights(reference.fraction[i]);
    const SplineWeights l = splineWeights(live.fraction[i]);
    double* row = sums + reference.bin[i] * side + live.bin[i];
    for (std::size_t a = 0; a < kSplineSupport; ++a, row += side) {
      for (std::size_t b = 0; b < kSplineSupport; ++b) row[b] += static_cast<double>(r[a] * l[b]);
    }
  }
}

void logarithms(const double* value, std::size_t n, double* logarithm) {
  for (std::size_t i = 0; i < n; ++i) logarithm[i] = value[i] > 0.0 ? std::log(value[i]) : 0.0;
}

void miDerivatives(const BinsView& reference, const BinsView& live, const float* active,
                   const float* jacobian_rows, const float* const jacobian[6],
                   const float* const second_derivative[21], std::size_t n, int side,
                   float bin_scale, const float* log_ratio, float* rows, MiSums& sums) {
  sums = MiSums{};
  for (std::size_t i = 0; i < n; ++i) {
    if (active[i] == 0.0F) continue;
    const SplineWeights first = splineDerivatives(reference.fraction[i]);
    const SplineWeights second = splineSecondDerivatives(reference.fraction[i]);
    const SplineWeights weights = splineWeights(live.fraction[i]);
    const float* J = jacobian_rows + i * kRowFloats;
    float g = 0.0F;
    float h = 0.0F;
    std::ptrdiff_t entry = std::ptrdiff_t{reference.bin[i]} * side + live.bin[i];
    for (std::size_t a = 0; a < kSplineSupport; ++a, entry += side) {
      for (std::size_t b = 0; b < kSplineSupport; ++b) {
        const auto place = entry + static_cast<std::ptrdiff_t>(b);
        const float product = first[a] * weights[b];
        g += product * log_ratio[place];
        h += second[a] * weights[b] * log_ratio[place];
        for (int k = 0; k < 6; ++k) rows[place * kRowFloats + k] += product * J[k];
      }
    }
    const float scaled = bin_scale * h;
    std::size_t out = 0;
    for (int row = 0; row < 6; ++row) {
      sums.gradient[row] += static_cast<double>(g * jacobian[row][i]);
      for (int column = row; column < 6; ++column, ++out) {
        sums.curvature[out] += static_cast<double>(scaled * jacobian[row][i] * jacobian[column][i] +
                                                   g * second_derivative[out][i]);
      }
    }
  }
}

}  // namespace reference
}  // namespace kernels
}  // namespace mivo
