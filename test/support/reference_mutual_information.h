// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/terms/joint_histogram.h"

// Mutual information by its definition, slow and in double precision. The tested implementation
// shares no code with it but the struct IntensityRange.

namespace mivo::testing {

/// Cubic B-spline kernel.
inline double cubicBspline(double s) {
  const double a = std::abs(s);
  if (a < 1.0) return 2.0 / 3.0 - a * a + 0.5 * a * a * a;
  if (a < 2.0) return (2.0 - a) * (2.0 - a) * (2.0 - a) / 6.0;
  return 0.0;
}

/// Place of an intensity on the axis of bins, clamped to the range.
inline double binPlace(double intensity, const IntensityRange& range, int num_bins) {
  const double low = static_cast<double>(range.low);
  const double high = static_cast<double>(range.high);
  const double place = (num_bins - 1) * (intensity - low) / (high - low);
  return std::min(std::max(place, 0.0), num_bins - 1.0);
}

/// Joint probabilities of pairs of places, (num_bins + 2) x (num_bins + 2): rows are bins -1 to
/// num_bins of the reference.
inline Eigen::MatrixXd jointProbabilities(const std::vector<double>& reference,
                                          const std::vector<double>& live, int num_bins) {
  const int side = num_bins + 2;
  Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(side, side);
  Eigen::VectorXd r(side);
  Eigen::VectorXd l(side);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    for (int bin = 0; bin < side; ++bin) {
      r[bin] = cubicBspline(reference[i] - (bin - 1));
      l[bin] = cubicBspline(live[i] - (bin - 1));
    }
    joint += r * l.transpose();
  }
  return joint / static_cast<double>(reference.size());
}

inline double entropy(const Eigen::MatrixXd& probabilities) {
  double sum = 0.0;
  for (int i = 0; i < probabilities.size(); ++i) {
    const double p = probabilities.data()[i];
    if (p > 0.0) sum -= p * std::log(p);
  }
  return sum;
}

/// H(reference) + H(live) - H(reference, live), nats.
inline double mutualInformation(const Eigen::MatrixXd& joint) {
  return entropy(joint.rowwise().sum()) + entropy(joint.colwise().sum()) - entropy(joint);
}

}  // namespace mivo::testing
