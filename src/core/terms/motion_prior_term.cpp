// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/motion_prior_term.h"

#include "core/symmetric.h"

namespace mivo {
namespace {

/// Derivative of localCoordinates(retract(d) T) at d = 0.
Matrix6 derivativeOfError(const Vector6& error) {
  const Eigen::Matrix3d r = skew(error.tail<3>());
  Matrix6 J = Matrix6::Identity();
  J.topRightCorner<3, 3>() = -skew(error.head<3>());
  // Inverse left Jacobian of SO(3) to the second order: errors of predictions are small.
  J.bottomRightCorner<3, 3>() += -0.5 * r + r * r / 12.0;
  return J;
}

}  // namespace

MotionPriorTerm::MotionPriorTerm(const Eigen::Isometry3d& T_live_ref_expected,
                                 const Matrix6& covariance, double weight)
    : T_expected_ref_(T_live_ref_expected),
      information_(weight * symmetricSolve(covariance, Matrix6(Matrix6::Identity()))) {}

double MotionPriorTerm::evaluate(const Eigen::Isometry3d& T_live_ref) {
  T_expected_live_ = T_expected_ref_ * T_live_ref.inverse();
  const Vector6 error = localCoordinates(T_expected_live_);
  return 0.5 * error.dot(information_ * error);
}

QuadraticModel MotionPriorTerm::linearize(int /*iteration*/) {
  const Vector6 error = localCoordinates(T_expected_live_);
  // T <- T retract(d)⁻¹ moves the error by an increment in the expected camera's axes.
  const Matrix6 J = derivativeOfError(error) * adjoint(T_expected_ref_);
  QuadraticModel model;
  model.cost = 0.5 * error.dot(information_ * error);
  model.gradient = J.transpose() * (information_ * error);
  model.hessian = J.transpose() * information_ * J;
  return model;
}

}  // namespace mivo
