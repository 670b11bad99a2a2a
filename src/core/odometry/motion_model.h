// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/terms/motion_prior_term.h"
#include "mivo/core/parameters.h"
#include "mivo/core/se3.h"

namespace mivo {

/// Constant velocity in whole frame periods: stamps jitter by a third of a period while the camera
/// is regular, so the number of periods between two frames is what counts, not their stamps.
class MotionModel {
 public:
  /// Adds a pose that can be trusted; stamps grow.
  void add(double stamp, const Eigen::Isometry3d& T_odom_camera);

  /// Notes the stamp of a frame without a pose: it still tells the frame period.
  void addStamp(double stamp);

  /// Expected pose at a stamp. The given pose before two have been added.
  Eigen::Isometry3d predict(double stamp, const Eigen::Isometry3d& last,
                            const Parameters& parameters) const;

  /// Velocity of the camera in its own axes, m/s and rad/s.
  Vector6 velocity(const Parameters& parameters) const;

  /// How far the prediction may be off, by the accelerations that the parameters expect. None
  /// before two poses have been added, when there is no velocity to be kept.
  MotionUncertainty uncertainty(double stamp, const Parameters& parameters) const;

  /// Forgets the velocity, keeps the frame period: the next pose is not a continuation.
  void stop();

  /// Expresses the poses in another world: T_new_old.
  void transform(const Eigen::Isometry3d& T_new_old);

  /// Whole frame periods from the last pose to a stamp, at least one.
  double periodsSince(double stamp, const Parameters& parameters) const;

  /// Frame period: the parameter, or the median of the last stamps' differences, s; 0: unknown.
  double period(const Parameters& parameters) const;

 private:
  double steps(double from, double to, const Parameters& parameters) const;

  std::vector<double> intervals_;  // the last ones, as a ring
  std::size_t next_interval_ = 0;
  double last_stamp_ = 0.0;
  bool has_stamp_ = false;
  struct Pose {
    double stamp;
    Eigen::Isometry3d T_odom_camera;
  };
  std::vector<Pose> poses_;  // the last two at most, older first
};

}  // namespace mivo
