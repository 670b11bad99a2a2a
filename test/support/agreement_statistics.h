// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "core/terms/agreement.h"

namespace mivo::testing {

/// Largest correlation, in absolute value, of the derivatives by keyframe and live frame in any
/// direction within the given axes.
inline double largestCorrelation(const Agreement& agreement, const std::vector<int>& axes) {
  const auto n = static_cast<Eigen::Index>(axes.size());
  Eigen::MatrixXd mean(n, n);
  Eigen::MatrixXd both(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const int row = axes[static_cast<std::size_t>(i)];
      const int column = axes[static_cast<std::size_t>(j)];
      mean(i, j) = 0.5 * (agreement.keyframe(row, column) + agreement.live(row, column));
      both(i, j) = agreement.both(row, column);
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(both, mean);
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace mivo::testing
