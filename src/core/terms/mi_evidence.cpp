// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/mi_evidence.h"

#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

// min(n, this): neighboring points are correlated, so that more of them add no significance. Equal
// to the default of min_points.
constexpr double kIndependentPoints = 1500.0;
// Eigenvalues of the correlation of the cubic B-spline windows between which intensities fall, for
// intensities that fill the bins as those of images do: their sum and the sum of their squares grow
// with the number of intervals between bins (mi_evidence_test measures both).
constexpr double kSumPerInterval = 0.485;
constexpr double kSumAtOnce = 0.35;
constexpr double kSquaresPerInterval = 0.345;
constexpr double kSquaresAtOnce = 0.5;
constexpr double kLeast = 0.1;  // of both, where there are next to no intervals

}  // namespace

MiEvidence miEvidence(double mutual_information, std::size_t num_pairs, int num_bins) {
  MiEvidence evidence;
  if (num_pairs == 0) return evidence;
  const double intervals = num_bins - 1.0;
  const double sum = std::max(kLeast, kSumPerInterval * intervals - kSumAtOnce);
  const double squares = std::max(kLeast, kSquaresPerInterval * intervals - kSquaresAtOnce);
  const auto n = static_cast<double>(num_pairs);
  const double bias = sum * sum / (2.0 * n);  // nats
  const double excess = std::max(0.0, mutual_information - bias);
  const double deviation = std::sqrt(2.0) * squares;  // of 2 n MI
  evidence.deviations = 2.0 * std::min(n, kIndependentPoints) * excess / deviation;
  evidence.correlation = std::sqrt(1.0 - std::exp(-2.0 * excess));
  return evidence;
}

}  // namespace mivo
