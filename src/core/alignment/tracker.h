// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

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

/// Two images of one camera and where to start.
struct AlignmentTask {
  const Keyframe& keyframe;
  const FramePyramid& live;
  const Camera& camera;
  Eigen::Isometry3d T_live_ref = Eigen::Isometry3d::Identity();  ///< start
  /// Pose of the frame before the live one and the frame periods between them: how the camera
  /// moves.
  Eigen::Isometry3d T_previous_ref = Eigen::Isometry3d::Identity();
  double periods = 1.0;
  ShutterTimes shutter = {};
  /// Contrast of the last view that could be compared by its image, see contrastInView(); less than
  /// the keyframe's: that counts.
  double last_lit_contrast = 0.0;
  /// Of the start, if it was predicted from a known velocity; 0: not known.
  MotionUncertainty uncertainty = {};
};

/// Result of aligning one frame with a keyframe.
struct Alignment {
  Eigen::Isometry3d T_live_ref = Eigen::Isometry3d::Identity();
  Matrix6 hessian = Matrix6::Identity();     ///< of the increment at T_live_ref, nats
  Matrix6 covariance = Matrix6::Identity();  ///< of the increment's error
  double condition = 0.0;               ///< weakest over strongest curvature on the finest level
  int points = 0;                       ///< in view on the finest level
  double overlap = 0.0;                 ///< fraction of the finest level's points in view
  bool sees_image = false;              ///< the images have something in common on the finest level
  bool is_live_dark = false;            ///< the live image shows too little to be compared
  bool is_keyframe_dark = false;        ///< that of the keyframe does
  bool sees_depth = false;              ///< the geometric term took part there
  double mutual_information = 0.0;      ///< nats, on the finest level that uses it
  double residual_scale = 0.0;          ///< grey levels, on the finest SSD level
  double depth_scale = 0.0;             ///< residuals of the geometric term in deviations (or 0)
  double correlation = 0.0;             ///< of the images, on the finest SSD level
  ReadoutMeasurement readout;           ///< what the frame says about it
  DepthOffsetMeasurement depth_offset;  ///< the same
  int num_levels = 0;
  std::array<LevelRecord, kMaxLevels> levels{};  ///< coarsest first

  /// Depth alone may tell the pose then.
  bool isDepthOnly() const { return is_live_dark || is_keyframe_dark; }
};

/// Aligns a frame with a keyframe from the coarsest level to the finest: mutual information or SSD
/// on each, as the parameters say (Algorithm 1), with the geometric term beside SSD, and alone
/// where the image is of no use. A level with too few points in view is passed over.
Alignment align(const AlignmentTask& task, const Parameters& parameters);

}  // namespace mivo
