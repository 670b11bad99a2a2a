// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/observability.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

// Gradients that agree by less than this share are noise: of two thousand points chance alone gives
// a twentieth, of five hundred a tenth.
constexpr double kLeastAgreement = 0.15;
// A motion belongs to an open direction when so much of the direction is along it.
constexpr double kPartOfDirection = 0.4;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// Multiplies increments measured in median depths to give those in metres.
Vector6 scaleOf(double length) {
  Vector6 scale = Vector6::Ones();
  scale.head<3>().setConstant(length);
  return scale;
}

Matrix within(const Matrix6& matrix, const Matrix& axes, const Vector6& scale) {
  const Matrix6 scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  return axes.transpose() * scaled * axes;
}

/// Of a term's curvature in a subspace, what both frames agree on: with H = L Lᵀ it is L R Lᵀ, R
/// the correlation of their derivatives, 1 where they are the same. Correlations below zero are
/// agreement too, for an image and its negative.
Matrix confirmed(const TermCurvature& term, const Matrix& axes, const Vector6& scale) {
  const Matrix H = within(term.hessian, axes, scale);
  const Matrix none = Matrix::Zero(H.rows(), H.cols());
  const Matrix mean = within(0.5 * (term.agreement.keyframe + term.agreement.live), axes, scale);
  const Matrix both = within(term.agreement.both, axes, scale);
  const double size = mean.trace();
  if (!(size > 0.0) || !H.allFinite()) return none;
  // Next to nothing in a direction is nothing; the bound keeps the factor regular.
  const Matrix regular = mean + 1e-12 * size * Matrix::Identity(H.rows(), H.cols());
  const Eigen::SelfAdjointEigenSolver<Matrix> means(regular);
  const Matrix whitening = means.operatorInverseSqrt();
  const Eigen::SelfAdjointEigenSolver<Matrix> correlation(Matrix(whitening * both * whitening));
  const auto counted = [](double rho) {
    const double agreement = std::min(1.0, std::abs(rho));
    return agreement < kLeastAgreement ? 0.0 : agreement;
  };
  const Matrix R = correlation.eigenvectors() *
                   correlation.eigenvalues().unaryExpr(counted).asDiagonal() *
                   correlation.eigenvectors().transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix> curvature(H);
  const Matrix root = curvature.eigenvectors() *
                      curvature.eigenvalues().cwiseAbs().cwiseSqrt().asDiagonal() *
                      curvature.eigenvectors().transpose();
  return root * R * root;
}

void findOpen(double min_condition, Observability& result) {
  const double least = min_condition * result.curvature.maxCoeff();
  for (int i = 0; i < 6; ++i) {
    const double curvature = result.curvature[i];
    result.is_open[static_cast<std::size_t>(i)] = !(curvature > least && curvature > 0.0);
  }
}

}  // namespace

bool Observability::hasOpen() const {
  return std::any_of(is_open.begin(), is_open.end(), [](bool open) { return open; });
}

double Observability::condition() const {
  const double strongest = curvature.maxCoeff();
  return strongest > 0.0 ? curvature.minCoeff() / strongest : 0.0;
}

Matrix6 Observability::openProjector() const {
  Matrix6 projector = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (is_open[static_cast<std::size_t>(i)]) projector += axes.col(i) * axes.col(i).transpose();
  }
  const Vector6 scale = scaleOf(length);
  return scale.asDiagonal() * projector * scale.cwiseInverse().asDiagonal();
}

Matrix6 Observability::covarianceOfSeen(const Matrix6& of_gradient) const {
  const Vector6 scale = scaleOf(length);
  Matrix6 inverse = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (is_open[static_cast<std::size_t>(i)]) continue;
    inverse += axes.col(i) * axes.col(i).transpose() / curvature[i];
  }
  const Matrix6 unscaled = scale.asDiagonal() * inverse * scale.asDiagonal();
  return unscaled * of_gradient * unscaled;
}

Matrix6 Observability::informationOfSeen(const Matrix6& of_gradient) const {
  const Vector6 scale = scaleOf(length);
  const Vector6 inverse = scale.cwiseInverse();
  const Matrix6 covariance =
      inverse.asDiagonal() * covarianceOfSeen(of_gradient) * inverse.asDiagonal();
  Matrix seen(6, 6);
  int count = 0;
  for (int i = 0; i < 6; ++i) {
    if (!is_open[static_cast<std::size_t>(i)]) seen.col(count++) = axes.col(i);
  }
  if (count == 0) return Matrix6::Zero();
  const Matrix basis = seen.leftCols(count);
  const Matrix of_basis = basis.transpose() * covariance * basis;
  const Matrix information = of_basis.ldlt().solve(Matrix(Matrix::Identity(count, count)));
  const Matrix6 scaled = basis * information * basis.transpose();
  return inverse.asDiagonal() * scaled * inverse.asDiagonal();
}

Observability observe(const Matrix6& hessian, double length, double min_condition) {
  Observability result;
  result.length = length;
  if (!hessian.allFinite()) return result;
  const Vector6 scale = scaleOf(length);
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(
      Matrix6(scale.asDiagonal() * hessian * scale.asDiagonal()));
  result.axes = solver.eigenvectors();
  result.curvature = solver.eigenvalues();
  findOpen(min_condition, result);
  return result;
}

Observability confirm(const Observability& first, const std::array<bool, 6>& in_doubt,
                      const std::vector<TermCurvature>& terms, double min_condition) {
  Matrix all(6, 6);
  std::array<int, 6> place{};
  int count = 0;
  for (int i = 0; i < 6; ++i) {
    if (!in_doubt[static_cast<std::size_t>(i)]) continue;
    place[static_cast<std::size_t>(count)] = i;
    all.col(count++) = first.axes.col(i);
  }
  if (count == 0) return first;
  const Matrix doubted = all.leftCols(count);
  const Vector6 scale = scaleOf(first.length);
  Matrix sum = Matrix::Zero(count, count);
  for (const TermCurvature& term : terms) sum += confirmed(term, doubted, scale);
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(sum);
  const Matrix turned = doubted * solver.eigenvectors();
  Observability result = first;
  for (int k = 0; k < count; ++k) {
    const int i = place[static_cast<std::size_t>(k)];
    result.axes.col(i) = turned.col(k);
    result.curvature[i] = solver.eigenvalues()[k];
  }
  findOpen(min_condition, result);
  return result;
}

Directions openDirections(const Observability& observability, const Eigen::Isometry3d& T_live_ref) {
  Directions directions{};
  const Vector6 scale = scaleOf(observability.length);
  const Matrix6 to_camera = adjoint(T_live_ref);
  for (int i = 0; i < 6; ++i) {
    if (!observability.is_open[static_cast<std::size_t>(i)]) continue;
    const Vector6 axis = scale.cwiseInverse().cwiseProduct(
        to_camera * scale.cwiseProduct(observability.axes.col(i)));
    const Vector6 part = axis.cwiseAbs() / axis.norm();
    for (int k = 0; k < 6; ++k) {
      if (part[k] >= kPartOfDirection) directions[static_cast<std::size_t>(k)] = true;
    }
  }
  return directions;
}

}  // namespace mivo
