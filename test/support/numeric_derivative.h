// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

// Central differences, with which analytic derivatives are compared.

namespace mivo::testing {

/// Derivative of a function R^N -> R^M at x: M x N.
template <int M, int N, typename Function>
Eigen::Matrix<double, M, N> numericJacobian(const Function& function,
                                            const Eigen::Matrix<double, N, 1>& x, double step) {
  Eigen::Matrix<double, M, N> result;
  for (int column = 0; column < N; ++column) {
    Eigen::Matrix<double, N, 1> offset = Eigen::Matrix<double, N, 1>::Zero();
    offset[column] = step;
    const Eigen::Matrix<double, M, 1> after = function(Eigen::Matrix<double, N, 1>(x + offset));
    const Eigen::Matrix<double, M, 1> before = function(Eigen::Matrix<double, N, 1>(x - offset));
    result.col(column) = (after - before) / (2.0 * step);
  }
  return result;
}

/// Gradient of a function R^N -> R at x.
template <int N, typename Function>
Eigen::Matrix<double, N, 1> numericGradient(const Function& function,
                                            const Eigen::Matrix<double, N, 1>& x, double step) {
  const auto wrapped = [&](const Eigen::Matrix<double, N, 1>& at) {
    return Eigen::Matrix<double, 1, 1>(function(at));
  };
  return numericJacobian<1, N>(wrapped, x, step).transpose();
}

/// Hessian of a function R^N -> R at x, by second differences of the values alone.
template <int N, typename Function>
Eigen::Matrix<double, N, N> numericHessian(const Function& function,
                                           const Eigen::Matrix<double, N, 1>& x, double step) {
  using Vector = Eigen::Matrix<double, N, 1>;
  Eigen::Matrix<double, N, N> result;
  for (int i = 0; i < N; ++i) {
    for (int j = i; j < N; ++j) {
      const Vector a = step * Vector::Unit(i);
      const Vector b = step * Vector::Unit(j);
      const double sum = function(Vector(x + a + b)) - function(Vector(x + a - b)) -
                         function(Vector(x - a + b)) + function(Vector(x - a - b));
      result(i, j) = result(j, i) = sum / (4.0 * step * step);
    }
  }
  return result;
}

/// Largest difference of two matrices, as a fraction of the largest entry of the second.
template <typename A, typename B>
double relativeError(const Eigen::MatrixBase<A>& value, const Eigen::MatrixBase<B>& truth) {
  const double size = truth.cwiseAbs().maxCoeff();
  const double error = (value - truth).cwiseAbs().maxCoeff();
  return error == 0.0 ? 0.0 : error / size;
}

/// Whether the central differences `numeric(step)` approach `analytic` as they must: halving the
/// step twice divides the error by about 16, until it is below `floor` (the rounding of the
/// function). A wrong derivative leaves an error that no step removes.
template <typename Matrix, typename Numeric>
bool convergesTo(const Matrix& analytic, const Numeric& numeric, double step, double floor) {
  constexpr double kWorstOrder = 8.0;  // half of the factor of second order
  const double coarse = relativeError(analytic, numeric(step));
  const double fine = relativeError(analytic, numeric(0.25 * step));
  return fine <= floor || (fine <= coarse / kWorstOrder && coarse < 0.2);
}

}  // namespace mivo::testing
