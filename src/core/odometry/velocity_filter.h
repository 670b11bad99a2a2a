// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/parameters.h"
#include "mivo/core/se3.h"

namespace mivo {

/// Motion of the camera between two measured poses.
struct MeasuredMotion {
  Vector6 twist = Vector6::Zero();  ///< in the axes of the camera, m and rad
  Matrix6 covariance = Matrix6::Zero();
  double periods = 1.0;              ///< frame periods that it took, whole
  double seconds = 0.0;              ///< and their length, positive
  bool has_open_directions = false;  ///< part of it is not measured but expected
};

/// Kalman filter of the camera's velocity, with random acceleration between motions. Where poses
/// are known well it follows the last motion; a motion between poses that are hardly known changes
/// it little, so that their errors do not lead the next prediction away. With another motion_model
/// than filtered_velocity the last motion alone counts.
class VelocityFilter {
 public:
  /// The velocity is arbitrary: zero, with the expected speeds as deviations.
  void reset(const MotionParameters& parameters);

  void add(const MeasuredMotion& motion, const MotionParameters& parameters);

  /// Motion in one frame period, in the axes of the camera, m and rad.
  const Vector6& twistPerPeriod() const { return twist_per_period_; }

  /// Covariance of the velocity's error during the next motion, (m/s)² and (rad/s)². Open
  /// directions leave it as it was when all were seen.
  const Matrix6& covariance() const { return covariance_; }

 private:
  Vector6 twist_per_period_ = Vector6::Zero();
  Matrix6 covariance_ = Matrix6::Zero();
  Matrix6 covariance_now_ = Matrix6::Zero();  // before the camera accelerates
  bool is_known_ = false;
};

}  // namespace mivo
