// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "mivo/core/se3.h"

namespace mivo {

/// Read-out times of a camera, in frame periods.
struct ShutterTimes {
  double readout = 0.0;       ///< from the first row to the last; 0: global shutter
  double depth_offset = 0.0;  ///< from a row of the color image to the same row of the depth image
};

/// Motion of the scene in a camera's axes while an image is taken: a row is read at the time tau
/// (frame periods) after that of the frame's pose, and a point X is at X + tau (w x X + v) then.
/// The pose of a frame is that of the middle row of its color image.
struct RowMotion {
  Vector6 twist = Vector6::Zero();  ///< (v, w), m and rad per frame period
  double readout = 0.0;             ///< periods from the first row to the last; 0: global shutter
  double offset = 0.0;              ///< periods from the time of the pose to that of the middle row

  bool isZero() const { return twist.isZero(0.0) || (readout == 0.0 && offset == 0.0); }

  double rowTime(double row, double height) const {
    return readout * (row / height - 0.5) + offset;
  }

  /// Displacement of a point of a row, meters.
  Eigen::Vector3d displacement(const Eigen::Vector3d& point, double row, double height) const {
    return rowTime(row, height) * (twist.tail<3>().cross(point) + twist.head<3>());
  }
};

/// Scene motion per frame period at the live frame and at the keyframe, and the pose between them.
struct RowVelocities {
  Vector6 live = Vector6::Zero();      ///< (v, w) in the axes of the live camera
  Vector6 keyframe = Vector6::Zero();  ///< (v, w) in the axes of the keyframe
  Eigen::Isometry3d T_live_ref = Eigen::Isometry3d::Identity();

  /// That of the live camera in the axes of the keyframe.
  Vector6 liveInKeyframe() const {
    const Eigen::Matrix3d R = T_live_ref.linear();
    const Eigen::Vector3d t = T_live_ref.translation();
    Vector6 velocity;
    velocity << R.transpose() * (live.tail<3>().cross(t) + live.head<3>()),
        R.transpose() * live.tail<3>();
    return velocity;
  }
};

}  // namespace mivo
