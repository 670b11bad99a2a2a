// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/alignment/pose_covariance.h"
#include "core/geometry/row_motion.h"
#include "core/images/frame_pyramid.h"
#include "core/keyframe/keyframe.h"
#include "core/shutter/depth_offset_estimator.h"
#include "core/shutter/readout_estimator.h"
#include "core/terms/motion_prior_term.h"
#include "mivo/core/camera.h"
#include "mivo/core/parameters.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// Prediction of the live camera's pose.
struct PoseExpectation {
  bool is_known = false;  ///< false: there is no prediction
  Eigen::Isometry3d T_live_ref = Eigen::Isometry3d::Identity();
  /// Of its error, in the axes of the expected camera, and of that of the keyframe in its own; both
  /// m and rad, in one world.
  Matrix6 covariance = Matrix6::Identity();
  Matrix6 keyframe_covariance = Matrix6::Zero();
  /// What the camera may have gone astray since the frame before, in its axes: it is in the
  /// covariance, and is not known better for what is known of the keyframe.
  Matrix6 drift = floorCovariance();

  /// Of the pose against the keyframe, whose own error is in both: in the axes of the expected
  /// camera, and as that of the increment.
  Matrix6 cameraCovariance() const;
  Matrix6 incrementCovariance() const;
};

/// How the live camera has moved since the frame before it.
struct LiveMotion {
  /// Pose of the previous frame; where that is unknown, the start.
  Eigen::Isometry3d T_previous_ref = Eigen::Isometry3d::Identity();
  double periods = 1.0;  ///< frame periods between the two
};

/// Two images of one camera and where to start.
struct AlignmentTask {
  const Keyframe& keyframe;
  const FramePyramid& live;
  const Camera& camera;
  Eigen::Isometry3d T_live_ref = Eigen::Isometry3d::Identity();  ///< start
  LiveMotion motion = {};
  ShutterTimes shutter = {};
  /// Contrast of the last view that was not dark, see contrastInView(); the keyframe's contrast is
  /// used if it is larger.
  double last_lit_contrast = 0.0;
  /// Holds the pose in open directions.
  PoseExpectation expected = {};
  /// Whether it is also used as a prior on coarse levels. Not when the search starts elsewhere than
  /// at the prediction.
  bool holds_coarse_levels = false;
  int skipped_levels = 0;  ///< of the coarsest, to be left out
};

/// Result of aligning one frame with a keyframe.
struct Alignment {
  Eigen::Isometry3d T_live_ref = Eigen::Isometry3d::Identity();
  Matrix6 hessian = Matrix6::Identity();     ///< of the increment at T_live_ref, nats
  Matrix6 covariance = Matrix6::Identity();  ///< of the increment's error
  bool has_open_directions = false;          ///< some directions are open
  Directions open_directions{};              ///< in the axes of the live camera
  Matrix6 open_projector = Matrix6::Zero();  ///< onto them, of motions in those axes
  int points = 0;                            ///< in view on the finest level
  double overlap = 0.0;                      ///< fraction of the finest level's points in view
  bool sees_image = false;                   ///< image and keyframe match on the finest level
  bool is_live_dark = false;                 ///< the live image has too little contrast
  bool is_keyframe_dark = false;             ///< the keyframe's image has too little contrast
  bool sees_depth = false;                   ///< the depth term was used on the finest level
  double mutual_information = 0.0;           ///< nats, on the finest level that uses it
  double residual_scale = 0.0;               ///< gray levels, on the finest SSD level
  double depth_scale = 0.0;             ///< residuals of the geometric term in deviations (or 0)
  double correlation = 0.0;             ///< of the images, on the finest level
  ReadoutMeasurement readout;           ///< measured by this frame
  DepthOffsetMeasurement depth_offset;  ///< the same
  int num_levels = 0;
  std::array<LevelRecord, kMaxLevels> levels{};  ///< coarsest first

  /// Depth alone may determine the pose then.
  bool isDepthOnly() const { return is_live_dark || is_keyframe_dark; }
};

/// Aligns a frame with a keyframe from the coarsest level to the finest: mutual information or SSD
/// on each, as the parameters say (Algorithm 1), with the depth term added to SSD, or alone where
/// the image is not informative. A level with too few points in view is skipped. Open directions
/// are held at the prediction.
Alignment align(const AlignmentTask& task, const Parameters& parameters);

}  // namespace mivo
