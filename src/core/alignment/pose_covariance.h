// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "mivo/core/se3.h"

namespace mivo {

// Covariances of a pose's error: T_true = T retract(error), translation (m) before rotation (rad).

/// The same standard deviation in every direction.
Matrix6 diagonalCovariance(double translation, double rotation);

/// Of a pose that is true by definition: rounding of depth and calibration.
Matrix6 floorCovariance();

/// Of a guessed pose: 1 m, 1 rad.
Matrix6 guessCovariance();

/// The nearest covariance whose variances are at least those of floorCovariance().
Matrix6 positivePart(const Matrix6& covariance);

/// Of the live camera's pose T_odom_ref T_ref_live. @param of_increment covariance of the increment
/// d of the alignment, T_odom_live = T_odom_ref retract(d) T_ref_live, which moves the live camera
/// by Ad(T_live_ref) d. @param of_reference covariance of T_odom_ref. Symmetric, positive definite.
Matrix6 liveCovariance(const Eigen::Isometry3d& T_live_ref, const Matrix6& of_increment,
                       const Matrix6& of_reference);

}  // namespace mivo
