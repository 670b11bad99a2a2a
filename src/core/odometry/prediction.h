// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/odometry/odometry_state.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Prediction of the camera's pose.
struct Prediction {
  double stamp = 0.0;  ///< s, of the frame
  /// The given pose, or the extrapolation by the motion model for at most half a second.
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
  bool is_given = false;
  Matrix6 covariance = Matrix6::Identity();  ///< of its error, in the axes of the camera
  Matrix6 drift = Matrix6::Identity();  ///< the part of it that has come up since the last pose
  double periods = 1.0;                 ///< since the last pose
  double seconds = 0.0;                 ///< since the last pose
};

/// @param start a pose from elsewhere, such as another odometry; null: none
Prediction predict(const OdometryState& state, double stamp, const Eigen::Isometry3d* start,
                   const MotionParameters& parameters);

/// The guess for a lost frame: the given pose if there is one; otherwise the prediction for half a
/// second, then the last measured pose.
Eigen::Isometry3d bestGuess(const OdometryState& state, const Prediction& prediction);

}  // namespace mivo
