// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace mivo {

/// Mutual information of a joint histogram held against what unrelated images reach by chance.
/// Means the same for any number of bins and points. With n pairs of independent intensities 2 n MI
/// is distributed as a sum of squares, as many as the windows of the bins leave independent.
struct MiEvidence {
  /// By how many standard deviations of chance it is more than chance reaches in the mean. Counts
  /// at most 1500 points: neighbours repeat each other.
  double deviations = 0.0;
  /// Correlation that two Gaussian images with as much mutual information would have, 0..1.
  double correlation = 0.0;
};

/// @param mutual_information nats, of `num_pairs` pairs in `num_bins` bins per axis
MiEvidence miEvidence(double mutual_information, std::size_t num_pairs, int num_bins);

}  // namespace mivo
