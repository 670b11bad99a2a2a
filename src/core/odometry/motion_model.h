// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/odometry/frame_clock.h"
#include "core/odometry/velocity_filter.h"
#include "mivo/core/parameters.h"
#include "mivo/core/se3.h"

namespace mivo {

/// s; motion is not extrapolated for longer, because the camera may have stopped.
constexpr double kMotionHorizon = 0.5;

/// A measured pose, possibly with open directions.
struct MeasuredPose {
  double stamp = 0.0;  ///< s
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
  /// Of its error in the axes of the camera, see TrackingResult::covariance.
  Matrix6 covariance = Matrix6::Zero();
  /// The part of it that the alignment alone has.
  Matrix6 alignment_covariance = Matrix6::Zero();
  /// Projects motions in the axes of the camera onto the open directions; zero: none is open.
  Matrix6 open_projector = Matrix6::Zero();
  bool has_open_directions = false;
};

/// Constant-velocity motion model in whole frame periods, extrapolating for at most half a second.
/// The velocity is that of VelocityFilter.
/// In open directions the last observed velocity is used for that long, and its growing uncertainty
/// is part of the covariance.
class MotionModel {
 public:
  /// Adds a pose; stamps grow.
  void add(const MeasuredPose& pose, const FrameClock& clock, const MotionParameters& parameters);

  /// Discards the poses: the next one is not a continuation.
  void stop();

  /// Expresses the poses in another world: T_new_old.
  void transform(const Eigen::Isometry3d& T_new_old);

  /// Whether two poses have been added since the start, or since stop().
  bool hasVelocity() const { return has_velocity_; }

  /// Predicted pose at a stamp; the given pose before two poses have been added.
  Eigen::Isometry3d predict(double stamp, const Eigen::Isometry3d& last, const FrameClock& clock,
                            const MotionParameters& parameters) const;

  /// Covariance of the error of that pose in the axes of the camera. If the velocity is unknown, it
  /// grows according to expected_speed and expected_turn_rate.
  Matrix6 covariance(double stamp, const FrameClock& clock,
                     const MotionParameters& parameters) const;

  /// The part of it that has come up since the last pose.
  Matrix6 drift(double stamp, const FrameClock& clock, const MotionParameters& parameters) const;

  /// Velocity of the camera between the last two poses, not filtered, in its own axes, m/s and
  /// rad/s; zero before two poses.
  Vector6 velocity(const FrameClock& clock, const MotionParameters& parameters) const;

  /// Whole frame periods from the last pose to a stamp, at least one.
  double periodsSince(double stamp, const FrameClock& clock,
                      const MotionParameters& parameters) const;

 private:
  double periods(const FrameClock& clock, const MotionParameters& parameters) const;
  double secondsUnseen(double stamp) const;
  Vector6 motionUntil(double stamp, const FrameClock& clock,
                      const MotionParameters& parameters) const;
  double secondsSinceLast(double stamp, const FrameClock& clock,
                          const MotionParameters& parameters) const;
  Matrix6 driftWithin(double seconds, const MotionParameters& parameters) const;

  bool has_pose_ = false;
  bool has_velocity_ = false;
  MeasuredPose last_;
  Vector6 motion_ = Vector6::Zero();  // from the pose before the last to it, in the camera's axes
  double previous_stamp_ = 0.0;       // of the pose before the last
  // The last pose without open directions, and the speed of the camera at that time.
  MeasuredPose seen_;
  double seen_speed_ = 0.0;      // m/s
  double seen_turn_rate_ = 0.0;  // rad/s
  VelocityFilter filter_;
};

}  // namespace mivo
