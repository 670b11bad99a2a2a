// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace mivo {

/// Significance of mutual information relative to unrelated images, independent of the numbers of
/// bins and points. For n pairs of independent intensities, 2 n MI is a sum of squared Gaussians,
/// as many as the overlapping windows of the bins leave independent.
struct MiEvidence {
  /// Number of standard deviations above the mean of unrelated images. Counts at most 1500 points,
  /// because neighbors are correlated.
  double deviations = 0.0;
  /// Correlation of two Gaussian images with the same mutual information, 0..1.
  double correlation = 0.0;
};

/// @param mutual_information nats, of `num_pairs` pairs in `num_bins` bins per axis
MiEvidence miEvidence(double mutual_information, std::size_t num_pairs, int num_bins);

}  // namespace mivo
