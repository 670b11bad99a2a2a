// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>

#include "mivo/core/se3.h"

namespace mivo {

/// Eigen's decompositions of symmetric matrices, compiled once: wherever one is used, its templates
/// take a compiler up to seven seconds.
Eigen::SelfAdjointEigenSolver<Matrix6> symmetricEigen(const Matrix6& matrix);
/// The X of matrix * X = right.
Matrix6 symmetricSolve(const Matrix6& matrix, const Matrix6& right);
Vector6 symmetricSolve(const Matrix6& matrix, const Vector6& right);

}  // namespace mivo
