// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/pose_covariance.h"

#include <algorithm>

#include "core/symmetric.h"

namespace mivo {
namespace {

// m and rad: larger than the motion during a few lost frames, small enough for filters.
constexpr double kGuessTranslation = 1.0;
constexpr double kGuessRotation = 1.0;
// m and rad: below the error of any alignment, far above the rounding of a 6 x 6 inverse.
constexpr double kFloorTranslation = 1e-5;
constexpr double kFloorRotation = 1e-5;

}  // namespace

Matrix6 diagonalCovariance(double translation, double rotation) {
  Vector6 variance;
  variance.head<3>().setConstant(translation * translation);
  variance.tail<3>().setConstant(rotation * rotation);
  return variance.asDiagonal();
}

Matrix6 floorCovariance() {
  return diagonalCovariance(kFloorTranslation, kFloorRotation);
}

Matrix6 guessCovariance() {
  return diagonalCovariance(kGuessTranslation, kGuessRotation);
}

Matrix6 positivePart(const Matrix6& covariance) {
  const auto solver = symmetricEigen(0.5 * (covariance + covariance.transpose()));
  constexpr double kLeast = std::min(kFloorTranslation, kFloorRotation);
  const Vector6 variances = solver.eigenvalues().cwiseMax(kLeast * kLeast);
  return solver.eigenvectors() * variances.asDiagonal() * solver.eigenvectors().transpose();
}

Matrix6 liveCovariance(const Eigen::Isometry3d& T_live_ref, const Matrix6& of_increment,
                       const Matrix6& of_reference) {
  const Matrix6 Ad = adjoint(T_live_ref);
  const Matrix6 covariance = Ad * (of_increment + of_reference) * Ad.transpose();
  return 0.5 * (covariance + covariance.transpose()) + floorCovariance();
}

}  // namespace mivo
