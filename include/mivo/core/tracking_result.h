// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>

#include "mivo/core/se3.h"

namespace mivo {

/// Most levels of a pyramid; the upper bound of the parameter `levels`.
constexpr int kMaxLevels = 8;

enum class TrackingState {
  kInitialising,  ///< no keyframe yet: the frame could not become one
  kTracking,      ///< the pose is good
  kDegraded,      ///< the pose is usable, but something is weak: see the reason
  kLost           ///< the pose is the best guess, not a measurement
};

/// Why the state is what it is.
enum class TrackingReason {
  kNone,               ///< tracking, nothing to say
  kInvalidFrame,       ///< refused: size, type or stamp of the frame does not fit
  kStaleStamp,         ///< refused: the stamp is not newer than that of the frame before
  kTooFewPoints,       ///< too little depth or texture for a keyframe, or to track
  kNoOverlap,          ///< too few of the keyframe's points are in view
  kNothingInCommon,    ///< the images have nothing in common: dark, covered, or another place
  kOpenDirections,     ///< image and depth leave directions of motion open: see open_directions
  kImplausibleMotion,  ///< faster than the limits allow
  kNotFinite           ///< the alignment diverged
};

/// Directions of motion in the axes of the camera, in the order of Vector6: sideways (x), up and
/// down (y), forward (z), turning about the same three axes. True: neither image nor depth fixes
/// it.
using Directions = std::array<bool, 6>;

const char* toString(TrackingState state);    ///< initialising, tracking, degraded, lost
const char* toString(TrackingReason reason);  ///< a few words, e.g. "too few points"

/// What happened on one pyramid level.
struct LevelRecord {
  int level = 0;
  int points = 0;                   ///< of the keyframe on this level
  int visible = 0;                  ///< of them used at the end
  int iterations = 0;               ///< steps taken
  int evaluations = 0;              ///< of the cost, line search included
  bool mutual_information = false;  ///< aligned by mutual information, otherwise by SSD
  /// At the end, nats for each point of the level: the sum of all terms that took part (negative MI
  /// or the robust loss of the residuals, of depth, of the motion expected).
  double cost = 0.0;
  double milliseconds = 0.0;              ///< processor time
  double line_search_milliseconds = 0.0;  ///< of it, in evaluations of the line search
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
  TrackingState state = TrackingState::kInitialising;
  TrackingReason reason = TrackingReason::kNone;

  /// Directions that the frame does not fix, with reason kOpenDirections: there the pose is what
  /// the motion so far expects, and the covariance grows until something is seen again.
  Directions open_directions{};

  /// The frame was not looked at, see findFault(): nothing here is of it, the pose is the last one.
  bool isRefused() const {
    return reason == TrackingReason::kInvalidFrame || reason == TrackingReason::kStaleStamp;
  }

  /// The pose was measured with this frame.
  bool isMeasured() const {
    return !isRefused() && (state == TrackingState::kTracking || state == TrackingState::kDegraded);
  }

  /// Pose of the colour optical frame in the odometry's world (the first camera pose unless set
  /// otherwise). When lost: the best guess.
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();

  /// Covariance of the pose's error (translation m, rotation rad) in the axes of the camera:
  /// T_true = T_odom_camera * retract(error). Symmetric and positive definite. It grows from
  /// keyframe to keyframe: it is that of the alignment and that of the keyframe together. Of the
  /// first frame, true by definition, it is next to nothing; of a guess, a metre and a radian and
  /// what the motion since the last good pose may add.
  Matrix6 covariance = Matrix6::Identity();

  /// The same of the alignment alone, with the keyframe's pose taken as true: what motion between
  /// frames of one keyframe is to be judged by.
  Matrix6 alignment_covariance = Matrix6::Identity();

  /// Velocity of the camera in its own axes: m/s and rad/s; zero until two poses are known.
  Vector6 velocity = Vector6::Zero();

  int keyframe = 0;  ///< number of the keyframe the frame was tracked against, from 1; 0: none
  bool new_keyframe = false;  ///< this frame became a keyframe
  int keyframes = 0;          ///< made so far
  /// Grows when tracking starts anew at a guessed pose; poses of one segment are connected by
  /// measurements. A camera that is found again by an older keyframe is back in its segment.
  int segment = 0;
  int points = 0;        ///< used on the finest level
  double overlap = 0.0;  ///< fraction of the keyframe's points in view, 0..1
  double mutual_information =
      0.0;                      ///< nats, with the keyframe, on the finest MI level (or 0: none)
  double residual_scale = 0.0;  ///< grey levels, robust, on the finest SSD level (or 0: none)

  double correlation = 0.0;  ///< of frame and keyframe, -1..1, on the finest SSD level (or 0)
  double rolling_shutter_readout = 0.0;  ///< s, given or estimated; 0: global shutter
  double depth_time_offset = 0.0;  ///< s from a row of colour to that of depth, given or estimated

  int num_levels = 0;  ///< entries of `levels`, coarsest first
  std::array<LevelRecord, kMaxLevels> levels{};
  StageTimes milliseconds;
};

/// The reason in a few words, with the open directions in the axes of the camera, e.g. "motion is
/// not observable: sideways, turning about the vertical axis".
std::string describeReason(const TrackingResult& result);

}  // namespace mivo
