// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <Eigen/Geometry>
#include <optional>

#include "mivo/core/parameters.h"
#include "ros/node_parameters.h"
#include "ros/transform_source.h"
#include "session/tracking_session.h"

namespace mivo {

/// Where another odometry says that the camera is. The motion is counted from the last pose that
/// was measured, so that it is whole however long the camera has been lost. One thread's own.
class MotionGuess {
 public:
  /// Without a guess_frame_id it asks nothing and knows nothing.
  MotionGuess(TransformSource& transforms, const NodeParameters& parameters)
      : transforms_(transforms), parameters_(parameters) {}

  /// Asks tf where the base is at the stamp of a frame, and waits for the answer: up to tf_timeout.
  void look(const ros::Time& stamp, const std::optional<Eigen::Isometry3d>& T_base_camera);

  /// Where the camera is in the tracker's world at the frame looked at, T_odom_camera; nothing when
  /// one end of the motion is not known. A base that went faster than the limits was put elsewhere
  /// by the other odometry: nothing is guessed then before a pose has been measured again.
  std::optional<Eigen::Isometry3d> start(const std::optional<StampedPose>& last_measured,
                                         const LossParameters& limits);

  /// The pose of the frame looked at was measured: motion is counted from there.
  void keep() { origin_ = now_; }

  /// Pose of the base in the other odometry's frame, at the frame looked at.
  const std::optional<Eigen::Isometry3d>& T_guess_base() const { return now_.T_guess_base; }

 private:
  struct Sight {  // of the base, by the other odometry
    ros::Time stamp;
    std::optional<Eigen::Isometry3d> T_base_camera;
    std::optional<Eigen::Isometry3d> T_guess_base;
    bool isKnown() const { return T_base_camera && T_guess_base; }
    Eigen::Isometry3d T_guess_camera() const { return *T_guess_base * *T_base_camera; }
  };

  bool hasJumped(const LossParameters& limits) const;

  TransformSource& transforms_;
  const NodeParameters& parameters_;
  Sight before_;  // at the frame before
  Sight now_;
  Sight origin_;  // at the last pose that was measured
};

}  // namespace mivo
