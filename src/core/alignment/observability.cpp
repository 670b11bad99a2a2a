// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/observability.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/symmetric.h"

namespace mivo {
namespace {

// Derivatives of noise correlate by 1 / sqrt(number of points), and by a few times that where
// neighbors share their noise.
constexpr double kDeviationsOfChance = 6.0;
// A direction with a larger standard deviation (median depths, rad) is open: it corresponds to
// about five pixels.
constexpr double kLargestDeviation = 0.01;
// A motion belongs to an open direction when so much of the direction is along it.
constexpr double kPartOfDirection = 0.4;
// Images are sampled and lenses calibrated to half a percent. A direction whose curvature is
// smaller than that squared, of the strongest, is seen by mistake: it is 0.0002 behind faint
// texture, 0.0006 and more in ordinary views, 0.000004 at most in open ones.
constexpr double kLeastCurvature = 2.5e-5;
// What looks as if it were seen along an open direction correlates about so much with what is seen
// across it.
constexpr double kCorrelationOfUnconfirmed = 0.15;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

Matrix within(const Matrix6& matrix, const Matrix& axes, const Vector6& scale) {
  const Matrix6 scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  return axes.transpose() * scaled * axes;
}

/// A covariance. Where a Hessian stands for one, the Hessian may be negative along some directions,
/// as that of MI is far from its maximum: it counts there by its size.
Matrix6 positive(const Matrix6& matrix) {
  if (!matrix.allFinite()) return matrix;
  const auto solver = symmetricEigen(matrix);
  if (solver.eigenvalues().minCoeff() >= 0.0) return matrix;
  return solver.eigenvectors() * solver.eigenvalues().cwiseAbs().asDiagonal() *
         solver.eigenvectors().transpose();
}

/// How the derivatives by keyframe and by live frame correlate in a subspace: directions (columns)
/// along which they do so independently of each other, and by how much, -1..1, ascending.
struct Correlation {
  Matrix directions, inverse;
  Vector rho;
};

std::optional<Correlation> correlationOf(const Agreement& agreement, const Matrix& axes,
                                         const Vector6& scale) {
  const Matrix by_keyframe = within(agreement.keyframe, axes, scale);
  const Matrix by_live = within(agreement.live, axes, scale);
  if (!(by_keyframe.trace() > 0.0 && by_live.trace() > 0.0)) return std::nullopt;
  // A blurred or darker live image has smaller derivatives throughout: no disagreement. Of an image
  // and its negative all derivatives disagree alike: none either.
  const double sign = agreement.both.trace() < 0.0 ? -1.0 : 1.0;
  const double gain = std::sqrt(by_keyframe.trace() / by_live.trace());
  const Matrix mean = 0.5 * (by_keyframe + gain * gain * by_live);
  const Matrix both = sign * gain * within(agreement.both, axes, scale);
  // The bound keeps the factor regular where a direction has almost no curvature.
  const Matrix regular = mean + 1e-12 * mean.trace() * Matrix::Identity(mean.rows(), mean.cols());
  const Eigen::SelfAdjointEigenSolver<Matrix> root(regular);
  const Matrix whitening = root.operatorInverseSqrt();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(Matrix(whitening * both * whitening));
  Correlation correlation;
  correlation.directions = whitening * solver.eigenvectors();
  correlation.inverse = solver.eigenvectors().transpose() * root.operatorSqrt();
  correlation.rho = solver.eigenvalues();
  return correlation;
}

/// Of a term's curvature in a subspace, what both frames agree on. With the directions A in which
/// their derivatives correlate by ρ, uncorrelated among each other, and P = A √ρ A⁻¹, it is Pᵀ H P:
/// nothing along those with ρ = 0, whatever H couples them with.
Matrix confirmed(const TermCurvature& term, const Matrix& axes, const Vector6& scale) {
  const Matrix H = within(term.hessian, axes, scale);
  const std::optional<Correlation> correlation = correlationOf(term.agreement, axes, scale);
  if (!correlation || !H.allFinite()) return Matrix::Zero(H.rows(), H.cols());
  const double of_chance =
      kDeviationsOfChance / std::sqrt(static_cast<double>(std::max(1, term.agreement.points)));
  const double least = std::max(term.agreement.has_steps ? term.least_agreement : 0.0, of_chance);
  const auto counted = [=](double rho) {
    return rho < least ? 0.0 : std::sqrt(std::min(1.0, rho));
  };
  const Matrix P = correlation->directions * correlation->rho.unaryExpr(counted).asDiagonal() *
                   correlation->inverse;
  return P.transpose() * H * P;
}

}  // namespace

Observability::Observability(const Matrix6& hessian, const ObservabilityInput& input)
    : scale_(Vector6::Ones()), open_deviations_(input.open_deviations) {
  scale_.head<3>().setConstant(input.length);
  const Vector6 inverse = scale_.cwiseInverse();
  gradient_covariance_ =
      positive(scale_.asDiagonal() * input.gradient_covariance * scale_.asDiagonal());
  expected_covariance_ = inverse.asDiagonal() * input.expected_covariance * inverse.asDiagonal();
  if (!hessian.allFinite()) return;
  hessian_ = scale_.asDiagonal() * hessian * scale_.asDiagonal();
  const auto solver = symmetricEigen(hessian_);
  axes_ = solver.eigenvectors();
  curvature_ = solver.eigenvalues();
  findOpen();
}

void Observability::findOpen() {
  const double strongest = curvature_.maxCoeff();
  for (int i = 0; i < 6; ++i) {
    const double h = curvature_[i];
    const double variance = axes_.col(i).dot(gradient_covariance_ * axes_.col(i)) / (h * h);
    const double expected = axes_.col(i).dot(expected_covariance_ * axes_.col(i));
    const bool is_seen = h > kLeastCurvature * strongest &&
                         variance <= kLargestDeviation * kLargestDeviation &&
                         variance <= open_deviations_ * open_deviations_ * expected;
    is_open_[static_cast<std::size_t>(i)] = !is_seen;
  }
}

void Observability::confirm(const std::array<bool, 6>& in_doubt,
                            const std::vector<TermCurvature>& terms) {
  Matrix doubted(6, 6);
  std::array<int, 6> place{};
  int count = 0;
  for (int i = 0; i < 6; ++i) {
    if (!in_doubt[static_cast<std::size_t>(i)]) continue;
    place[static_cast<std::size_t>(count)] = i;
    doubted.col(count++) = axes_.col(i);
  }
  if (count == 0) return;
  doubted.conservativeResize(6, count);
  Matrix sum = Matrix::Zero(count, count);
  for (const TermCurvature& term : terms) sum += confirmed(term, doubted, scale_);
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(sum);
  const Matrix turned = doubted * solver.eigenvectors();
  for (int k = 0; k < count; ++k) {
    const int i = place[static_cast<std::size_t>(k)];
    axes_.col(i) = turned.col(k);
    curvature_[i] = solver.eigenvalues()[k];
  }
  findOpen();
}

double Observability::leastCorrelation(const TermCurvature& term) const {
  const std::optional<Correlation> correlation = correlationOf(term.agreement, axes_, scale_);
  return correlation ? correlation->rho.minCoeff() : 0.0;
}

bool Observability::hasOpen() const {
  return std::any_of(is_open_.begin(), is_open_.end(), [](bool open) { return open; });
}

Matrix6 Observability::openProjector() const {
  Matrix6 projector = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (is_open_[static_cast<std::size_t>(i)]) projector += axes_.col(i) * axes_.col(i).transpose();
  }
  return scale_.asDiagonal() * projector * scale_.cwiseInverse().asDiagonal();
}

Matrix6 Observability::scaledCovarianceOfSeen() const {
  Matrix6 inverse = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (is_open_[static_cast<std::size_t>(i)]) continue;
    inverse += axes_.col(i) * axes_.col(i).transpose() / curvature_[i];
  }
  return inverse * gradient_covariance_ * inverse;
}

Matrix6 Observability::covarianceOfSeen() const {
  return scale_.asDiagonal() * scaledCovarianceOfSeen() * scale_.asDiagonal();
}

Matrix6 Observability::informationOfSeen() const {
  Matrix seen(6, 6);
  int count = 0;
  for (int i = 0; i < 6; ++i) {
    if (!is_open_[static_cast<std::size_t>(i)]) seen.col(count++) = axes_.col(i);
  }
  if (count == 0) return Matrix6::Zero();
  seen.conservativeResize(6, count);
  const Matrix covariance =
      seen.transpose() *
      (scaledCovarianceOfSeen() + scaledCovarianceOfDirections(expected_covariance_)) * seen;
  const Matrix information = covariance.ldlt().solve(Matrix(Matrix::Identity(count, count)));
  const Matrix6 scaled = seen * information * seen.transpose();
  const Vector6 inverse = scale_.cwiseInverse();
  return inverse.asDiagonal() * scaled * inverse.asDiagonal();
}

Matrix6 Observability::scaledCovarianceOfDirections(const Matrix6& scaled) const {
  double wrongly_seen = 0.0;
  for (int i = 0; i < 6; ++i) {
    if (!is_open_[static_cast<std::size_t>(i)]) continue;
    const double unconfirmed = std::max(0.0, axes_.col(i).dot(hessian_ * axes_.col(i)));
    wrongly_seen += unconfirmed * axes_.col(i).dot(scaled * axes_.col(i));
  }
  Matrix6 of_seen = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (is_open_[static_cast<std::size_t>(i)]) continue;
    of_seen += wrongly_seen / curvature_[i] * axes_.col(i) * axes_.col(i).transpose();
  }
  return kCorrelationOfUnconfirmed * kCorrelationOfUnconfirmed * of_seen;
}

Matrix6 Observability::covarianceOfDirections(const Matrix6& covariance) const {
  const Vector6 inverse = scale_.cwiseInverse();
  const Matrix6 scaled = inverse.asDiagonal() * covariance * inverse.asDiagonal();
  return scale_.asDiagonal() * scaledCovarianceOfDirections(scaled) * scale_.asDiagonal();
}

Directions Observability::openDirections(const Eigen::Isometry3d& T_live_ref) const {
  Directions directions{};
  const Matrix6 to_camera = adjoint(T_live_ref);
  for (int i = 0; i < 6; ++i) {
    if (!is_open_[static_cast<std::size_t>(i)]) continue;
    const Vector6 increment = scale_.cwiseProduct(axes_.col(i));
    const Vector6 axis = scale_.cwiseInverse().cwiseProduct(to_camera * increment);
    const Vector6 part = axis.cwiseAbs() / axis.norm();
    for (int k = 0; k < 6; ++k) {
      if (part[k] >= kPartOfDirection) directions[static_cast<std::size_t>(k)] = true;
    }
  }
  return directions;
}

}  // namespace mivo
