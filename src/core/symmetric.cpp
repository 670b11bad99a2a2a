// SPDX-License-Identifier: BSD-3-Clause
#include "core/symmetric.h"

#include <Eigen/Cholesky>

namespace mivo {

Eigen::SelfAdjointEigenSolver<Matrix6> symmetricEigen(const Matrix6& matrix) {
  return Eigen::SelfAdjointEigenSolver<Matrix6>(matrix);
}

Matrix6 symmetricSolve(const Matrix6& matrix, const Matrix6& right) {
  return matrix.ldlt().solve(right);
}

Vector6 symmetricSolve(const Matrix6& matrix, const Vector6& right) {
  return matrix.ldlt().solve(right);
}

}  // namespace mivo
