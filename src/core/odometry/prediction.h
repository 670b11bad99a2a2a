// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/odometry/odometry_state.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Where the camera should be before its image is looked at.
struct Prediction {
  double stamp = 0.0;  ///< s, of the frame
  /// The pose that was given, or where the motion so far leads within half a second.
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

/// The best guess when a frame says nothing: the prediction as long as the motion is continued,
/// after that the last good pose; always the pose that was given.
Eigen::Isometry3d bestGuess(const OdometryState& state, const Prediction& prediction);

}  // namespace mivo
