// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>

#include "mivo/core/se3.h"

namespace mivo {

/// Maximum number of pyramid levels, the upper bound of the parameter `levels`.
constexpr int kMaxLevels = 8;

enum class TrackingState {
  kInitializing,  ///< no keyframe yet: the frame could not become one
  kTracking,      ///< the pose is measured
  kDegraded,      ///< the pose is measured, but weak: see the reason
  kLost           ///< the pose is a guess
};

/// Why the state is what it is.
enum class TrackingReason {
  kNone,               ///< nothing is wrong
  kInvalidFrame,       ///< refused: size, type or stamp does not match
  kStaleStamp,         ///< refused: the stamp is not newer than that of the frame before
  kTooFewPoints,       ///< too little depth or texture for a keyframe, or to track
  kNoOverlap,          ///< too few of the keyframe's points are in view
  kNothingInCommon,    ///< image unrelated to the keyframe: dark, covered, or another place
  kOpenDirections,     ///< image and depth do not constrain all directions: see open_directions
  kAmbiguous,          ///< two poses match the image equally well: the covariance includes both
  kImplausibleMotion,  ///< faster than the limits allow
  kNotFinite           ///< the alignment diverged
};

/// Directions of motion in the axes of the camera, in the order of Vector6: translation along x
/// (right), y (down), z (forward), rotation about the same axes. True: not constrained by image or
/// depth.
using Directions = std::array<bool, 6>;

const char* toString(TrackingState state);    ///< initializing, tracking, degraded, lost
const char* toString(TrackingReason reason);  ///< a few words

/// Alignment on one pyramid level.
struct LevelRecord {
  int level = 0;
  int points = 0;                   ///< of the keyframe on this level
  int visible = 0;                  ///< of them used at the end
  int iterations = 0;               ///< steps taken
  int evaluations = 0;              ///< of the cost, line search included
  bool mutual_information = false;  ///< aligned by mutual information, otherwise by SSD
  /// Final cost, nats per point of the level: the sum of all terms (negative MI or robust loss of
  /// the residuals, depth, motion prior).
  double cost = 0.0;
  double milliseconds = 0.0;              ///< processor time
  double line_search_milliseconds = 0.0;  ///< part of it in the line search
};

/// Processor time of one frame by stage, milliseconds.
struct StageTimes {
  double pyramid = 0.0;
  double tracking = 0.0;
  double keyframe = 0.0;
  double total = 0.0;
};

/// Output of Odometry for one frame. All numbers are finite in every state.
struct TrackingResult {
  double stamp = 0.0;  ///< s, of the frame
  TrackingState state = TrackingState::kInitializing;
  TrackingReason reason = TrackingReason::kNone;

  /// Directions that the frame does not constrain, with reason kOpenDirections. Along them the pose
  /// is the prediction of the motion model, and the covariance grows until they are constrained
  /// again.
  Directions open_directions{};

  /// The frame was not tracked, see findFault(): the pose is the last one, all other values are
  /// empty.
  bool isRefused() const {
    return reason == TrackingReason::kInvalidFrame || reason == TrackingReason::kStaleStamp;
  }

  /// The pose was measured with this frame.
  bool isMeasured() const {
    return !isRefused() && (state == TrackingState::kTracking || state == TrackingState::kDegraded);
  }

  /// Pose of the color camera's optical frame in the world, which is the first camera pose unless
  /// set otherwise. When lost: a guess.
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();

  /// Covariance of the pose's error (translation m, rotation rad) in the axes of the camera:
  /// T_true = T_odom_camera * retract(error). Symmetric and positive definite. It is the sum of the
  /// covariances of the alignment and of the keyframe's pose, and therefore grows from keyframe to
  /// keyframe. The first pose is true by definition (10^-5 m, 10^-5 rad); a guess has 1 m, 1 rad
  /// and the possible motion since the last measured pose.
  Matrix6 covariance = Matrix6::Identity();

  /// The same of the alignment alone, with the keyframe's pose assumed to be exact. Use it to judge
  /// motion between frames of one keyframe.
  Matrix6 alignment_covariance = Matrix6::Identity();

  /// Velocity of the camera in its own axes: m/s and rad/s; zero until two poses are known.
  Vector6 velocity = Vector6::Zero();

  int keyframe = 0;  ///< number of the keyframe the frame was tracked against, from 1; 0: none
  bool new_keyframe = false;  ///< this frame became a keyframe
  int keyframes = 0;          ///< created so far
  /// Increases when tracking restarts at a guessed pose; poses of one segment are connected by
  /// measurements. A camera that is relocalized by an older keyframe returns to its segment.
  int segment = 0;
  int points = 0;        ///< used on the finest level
  double overlap = 0.0;  ///< fraction of the keyframe's points in view, 0..1
  double mutual_information =
      0.0;                      ///< nats, with the keyframe, on the finest MI level (or 0: none)
  double residual_scale = 0.0;  ///< gray levels, robust, on the finest SSD level (or 0: none)

  double correlation = 0.0;  ///< of frame and keyframe, -1..1, on the finest SSD level (or 0)
  double rolling_shutter_readout = 0.0;  ///< s, given or estimated; 0: global shutter
  double depth_time_offset = 0.0;  ///< s from a row of color to that of depth, given or estimated

  int num_levels = 0;  ///< entries of `levels`, coarsest first
  std::array<LevelRecord, kMaxLevels> levels{};
  StageTimes milliseconds;
};

/// The reason in a few words, with the open directions in the axes of the camera, e.g. "motion is
/// not observable: sideways, turning about the vertical axis".
std::string describeReason(const TrackingResult& result);

}  // namespace mivo
