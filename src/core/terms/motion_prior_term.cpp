// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/motion_prior_term.h"

namespace mivo {
namespace {

/// Derivative of localCoordinates(retract(d) T) at d = 0.
Matrix6 derivativeOfError(const Vector6& error) {
  const Eigen::Matrix3d r = skew(error.tail<3>());
  Matrix6 J = Matrix6::Identity();
  J.topRightCorner<3, 3>() = -skew(error.head<3>());
  // Inverse left Jacobian of SO(3) to the second order: predictions are not off by radians.
  J.bottomRightCorner<3, 3>() += -0.5 * r + r * r / 12.0;
  return J;
}

}  // namespace

MotionPriorTerm::MotionPriorTerm(const Eigen::Isometry3d& T_live_ref_predicted,
                                 const MotionUncertainty& uncertainty, double weight)
    : T_predicted_ref_(T_live_ref_predicted), uncertainty_(uncertainty), weight_(weight) {}

Vector6 MotionPriorTerm::information() const {
  Vector6 information;
  information.head<3>().setConstant(weight_ /
                                    (uncertainty_.translation * uncertainty_.translation));
  information.tail<3>().setConstant(weight_ / (uncertainty_.rotation * uncertainty_.rotation));
  return information;
}

double MotionPriorTerm::evaluate(const Eigen::Isometry3d& T_live_ref) {
  T_predicted_live_ = T_predicted_ref_ * T_live_ref.inverse();
  const Vector6 error = localCoordinates(T_predicted_live_);
  return 0.5 * error.dot(information().cwiseProduct(error));
}

QuadraticModel MotionPriorTerm::linearise(int /*iteration*/) {
  const Vector6 error = localCoordinates(T_predicted_live_);
  // T <- T retract(d)⁻¹ moves the error by an increment in the predicted camera's axes.
  const Matrix6 J = derivativeOfError(error) * adjoint(T_predicted_ref_);
  QuadraticModel model;
  model.cost = 0.5 * error.dot(information().cwiseProduct(error));
  model.gradient = J.transpose() * information().cwiseProduct(error);
  model.hessian = J.transpose() * information().asDiagonal() * J;
  return model;
}

int MotionPriorTerm::gradientCovariance(Matrix6& covariance) const {
  const Matrix6 J =
      derivativeOfError(localCoordinates(T_predicted_live_)) * adjoint(T_predicted_ref_);
  // The prior's own variance, counted `weight` times in gradient and Hessian.
  covariance = weight_ * (J.transpose() * information().asDiagonal() * J);
  return 0;
}

}  // namespace mivo
