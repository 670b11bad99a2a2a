// SPDX-License-Identifier: BSD-3-Clause
#include "session/twist_covariance.h"

#include "core/symmetric.h"

namespace mivo {

Matrix6 boundedCovariance(const Matrix6& covariance) {
  if (!covariance.allFinite()) return Matrix6::Identity() * kUnknownVariance;
  const Matrix6 symmetric = 0.5 * (covariance + covariance.transpose());
  const auto solver = symmetricEigen(symmetric);
  const Vector6 values = solver.eigenvalues();
  if (solver.info() != Eigen::Success) return Matrix6::Identity() * kUnknownVariance;
  if (values.minCoeff() >= kMinVariance && values.maxCoeff() <= kMaxVariance) return symmetric;
  const Vector6 bounded = values.cwiseMax(kMinVariance).cwiseMin(kMaxVariance);
  const Matrix6 result =
      solver.eigenvectors() * bounded.asDiagonal() * solver.eigenvectors().transpose();
  return 0.5 * (result + result.transpose());
}

Matrix6 twistCovariance(const Matrix6& before, const Matrix6& now, double seconds) {
  if (!(seconds > 0.0)) return Matrix6::Identity() * kUnknownVariance;
  return boundedCovariance((before + now) / (seconds * seconds));
}

}  // namespace mivo
