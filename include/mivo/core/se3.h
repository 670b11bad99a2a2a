// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

// Rigid motions. T_a_b maps coordinates in b to coordinates in a. Six-vectors hold the translation
// first, then the rotation: meters and radians.

namespace mivo {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The matrix [v]x with [v]x u = v x u.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation by |w| radians about w.
Eigen::Matrix3d expSo3(const Eigen::Vector3d& w);

/// Rotation vector of R, length 0 to pi.
Eigen::Vector3d logSo3(const Eigen::Matrix3d& R);

/// The tracker's increment: X -> exp(w) X + v with d = (v, w). Agrees to first order with the
/// paper's Euler angles (Sec. II-B) and with expSe3.
Eigen::Isometry3d retract(const Vector6& d);

/// Inverse of retract: (translation, rotation vector).
Vector6 localCoordinates(const Eigen::Isometry3d& T);

/// Exponential of the twist (v, w) in SE(3): the screw motion.
Eigen::Isometry3d expSe3(const Vector6& twist);

/// Twist of a rigid motion; the paper's Eq. 6 measures errors by it.
Vector6 logSe3(const Eigen::Isometry3d& T);

/// Whether the numbers are finite and the 3 x 3 part is a rotation: orthonormal within 0.001, and
/// not a reflection.
bool isRigid(const Eigen::Isometry3d& T);

/// The same motion with an orthonormalized rotation. Needed for products of many motions: with the
/// transpose as inverse, rounding errors would triple with each frame.
Eigen::Isometry3d orthonormalized(const Eigen::Isometry3d& T);

/// Adjoint in the order (translation, rotation): twist_a = adjoint(T_a_b) twist_b.
Matrix6 adjoint(const Eigen::Isometry3d& T);

}  // namespace mivo
