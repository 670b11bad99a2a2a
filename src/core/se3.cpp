// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/se3.h"

#include <cmath>

namespace mivo {
namespace {

// Below this angle (rad) the series are exact to double precision.
constexpr double kSmallAngle = 1e-4;

/// Left Jacobian of SO(3): the translation of expSe3 is V(w) v.
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const double square = angle * angle;
  const Eigen::Matrix3d W = skew(w);
  const bool small = angle < kSmallAngle;
  const double a = small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
  const double b =
      small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
  return Eigen::Matrix3d::Identity() + a * W + b * W * W;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Eigen::Matrix3d expSo3(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < kSmallAngle) {
    // Quaternion series: unit up to the fourth power of the angle, then normalized.
    const double square = angle * angle;
    Eigen::Quaterniond q;
    q.w() = 1.0 - square / 8.0;
    q.vec() = (0.5 - square / 48.0) * w;
    return q.normalized().toRotationMatrix();
  }
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::Vector3d logSo3(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();  // of the half angle
  const double factor = sine < kSmallAngle
                            ? 2.0 / q.w() * (1.0 - sine * sine / (3.0 * q.w() * q.w()))
                            : 2.0 * std::atan2(sine, q.w()) / sine;
  return factor * q.vec();
}

Eigen::Isometry3d retract(const Vector6& d) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = expSo3(d.tail<3>());
  T.translation() = d.head<3>();
  return T;
}

Vector6 localCoordinates(const Eigen::Isometry3d& T) {
  Vector6 d;
  d << T.translation(), logSo3(T.linear());
  return d;
}

Eigen::Isometry3d expSe3(const Vector6& twist) {
  const Eigen::Vector3d w = twist.tail<3>();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = expSo3(w);
  T.translation() = leftJacobian(w) * twist.head<3>();
  return T;
}

Vector6 logSe3(const Eigen::Isometry3d& T) {
  const Eigen::Vector3d w = logSo3(T.linear());
  Vector6 twist;
  twist << leftJacobian(w).partialPivLu().solve(T.translation()), w;
  return twist;
}

bool isRigid(const Eigen::Isometry3d& T) {
  constexpr double kTolerance = 1e-3;  // rounding in single precision is far below
  const Eigen::Matrix3d R = T.linear();
  return T.matrix().allFinite() && (R.transpose() * R).isIdentity(kTolerance) &&
         R.determinant() > 0.0;
}

Eigen::Isometry3d orthonormalized(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

Matrix6 adjoint(const Eigen::Isometry3d& T) {
  Matrix6 result = Matrix6::Zero();
  result.topLeftCorner<3, 3>() = T.linear();
  result.bottomRightCorner<3, 3>() = T.linear();
  result.topRightCorner<3, 3>() = skew(T.translation()) * T.linear();
  return result;
}

}  // namespace mivo
