// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/keyframe/keyframe_policy.h"
#include "core/odometry/frame_clock.h"
#include "core/odometry/motion_model.h"
#include "core/shutter/shutter_model.h"

namespace mivo {

/// State of the odometry except keyframes. A value: each frame creates a new one.
struct OdometryState {
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();  ///< last measured pose
  double pose_stamp = 0.0;                                          ///< s, of it
  double last_stamp = 0.0;                                          ///< s, of the last frame
  bool has_stamp = false;
  FrameClock clock;
  MotionModel motion;
  ShutterModel shutter;
  ShutterTimes shutter_times;     ///< in use: those of the current keyframe's points
  KeyframeQuality first_quality;  ///< of the first frame tracked against the current keyframe
  bool is_pose_given = true;      ///< the next keyframe's pose is the user's, not a guess
  int num_keyframes = 0;
  int segment = 0;       ///< of the last pose
  int num_segments = 1;  ///< so far
  int lost_in_a_row = 0;
};

}  // namespace mivo
