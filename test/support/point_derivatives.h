// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/se3.h"

// The derivatives of a point's intensity in double precision, written with matrices. The kernels
// are compared with them; they are compared with central differences.

namespace mivo::testing {

/// First and second derivative of the intensity at one point with respect to the increment.
struct PointDerivatives {
  Vector6 jacobian;
  Matrix6 second;
};

/// Rows: derivative of X/Z and Y/Z with respect to X, Y, Z.
inline Eigen::Matrix<double, 2, 3> projectionJacobian(const Eigen::Vector3d& point) {
  const double inverse = 1.0 / point.z();
  Eigen::Matrix<double, 2, 3> J;
  J << inverse, 0.0, -point.x() * inverse * inverse, 0.0, inverse, -point.y() * inverse * inverse;
  return J;
}

/// From the image's derivatives with respect to undistorted normalized coordinates (X / Z, Y / Z).
inline PointDerivatives pointDerivatives(const Eigen::Vector3d& point,
                                         const Eigen::Vector2d& normalized_gradient,
                                         const Eigen::Matrix2d& normalized_hessian) {
  const Eigen::Matrix<double, 2, 3> projection = projectionJacobian(point);
  const Eigen::Vector3d g = projection.transpose() * normalized_gradient;  // d I / d (X, Y, Z)
  PointDerivatives result;
  result.jacobian << g, point.cross(g);

  // Second derivative with respect to (X, Y, Z): through the image, and through the projection.
  Eigen::Matrix3d Q = projection.transpose() * normalized_hessian * projection;
  const double inverse_square = 1.0 / (point.z() * point.z());
  const Eigen::Vector2d bend = normalized_gradient * inverse_square;
  Q.topRightCorner<2, 1>() -= bend;
  Q.bottomLeftCorner<1, 2>() -= bend.transpose();
  Q(2, 2) += 2.0 * bend.dot(point.head<2>()) / point.z();

  Eigen::Matrix<double, 3, 6> D;  // d (exp(w) X + v) / d (v, w)
  D << Eigen::Matrix3d::Identity(), -skew(point);
  result.second = D.transpose() * Q * D;
  // Second order of the rotation itself: exp(w) X = X + w x X + w x (w x X) / 2.
  result.second.bottomRightCorner<3, 3>() += 0.5 * (g * point.transpose() + point * g.transpose()) -
                                             g.dot(point) * Eigen::Matrix3d::Identity();
  return result;
}

}  // namespace mivo::testing
