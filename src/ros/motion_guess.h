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

/// Pose of the camera by another odometry: the last measured pose, moved by the other odometry
/// since then, however long the camera has been lost. Not thread-safe.
class MotionGuess {
 public:
  /// Does nothing without guess_frame_id.
  MotionGuess(TransformSource& transforms, const NodeParameters& parameters)
      : transforms_(transforms), parameters_(parameters) {}

  /// Looks up the base at the stamp of a frame, waiting for tf_timeout at most.
  void look(const ros::Time& stamp, const std::optional<Eigen::Isometry3d>& T_base_camera);

  /// T_odom_camera at the current frame; empty when one end of the motion is not known. If the base
  /// moved faster than the limits, the other odometry was reset: there is no guess until a pose has
  /// been measured again.
  std::optional<Eigen::Isometry3d> start(const std::optional<StampedPose>& last_measured,
                                         const LossParameters& limits);

  /// The pose of the current frame was measured: it becomes the origin of the motion.
  void keep() { origin_ = now_; }

  /// Pose of the base in the other odometry's frame, at the current frame.
  const std::optional<Eigen::Isometry3d>& T_guess_base() const { return now_.T_guess_base; }

 private:
  struct Sight {  // pose of the base by the other odometry
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
