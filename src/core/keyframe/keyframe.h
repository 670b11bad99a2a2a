// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/row_motion.h"
#include "core/images/depth_pyramid.h"
#include "core/images/frame_pyramid.h"
#include "core/keyframe/geometric_points.h"
#include "core/keyframe/reference_points.h"
#include "core/terms/mi_term.h"
#include "mivo/core/camera.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// One level of a keyframe.
struct KeyframeLevel {
  ReferencePoints points;
  MiReference mi;  ///< only on levels that use mutual information
};

/// The reference of the alignment: the points of each level, and what depends on them alone. The
/// coarsest level uses all pixels with depth, the others the salient ones (section III-C).
class Keyframe {
 public:
  /// Fills the keyframe from a frame; buffers are reused. @param twist_per_period motion of the
  /// scene in the camera's axes per frame period.
  void build(const FramePyramid& frame, const Camera& camera, const Vector6& twist_per_period,
             const ShutterTimes& shutter, const Parameters& parameters);

  /// The two halves of build(), so that no single frame has to wait for both: choosing the points,
  /// and computing what depends on them. Between them there are image, depth and number of points.
  void choosePoints(const FramePyramid& frame, const Vector6& twist_per_period,
                    const ShutterTimes& shutter, const Parameters& parameters);
  /// In between: where the image gave too few points to tell what is in view, depth gives them; to
  /// a keyframe that shows less contrast than the last one that could be compared, or next to
  /// nothing.
  void choosePointsByDepth(double last_lit_contrast, const Parameters& parameters);
  void finish(const FramePyramid& frame, const Camera& camera, const Parameters& parameters);

  /// See FramePyramid::contrastInView().
  double contrastInView() const { return contrast_in_view_; }

  const Vector6& twistPerPeriod() const { return twist_per_period_; }

  int numLevels() const { return static_cast<int>(levels_.size()); }
  const KeyframeLevel& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }

  /// Points on level 0, where they decide on the precision.
  std::size_t numPoints() const { return levels_.front().points.size(); }
  double medianDepth() const { return static_cast<double>(levels_.front().points.median_depth); }

  /// Points of the geometric term; none without it.
  const GeometricPoints& geometricPoints() const { return geometric_points_; }

  const cv::Mat& image() const { return image_; }                   ///< CV_8UC1
  const cv::Mat& depth() const { return depth_pyramid_.level(0); }  ///< CV_32FC1 m, 0: none

 private:
  std::vector<KeyframeLevel> levels_;
  DepthPyramid depth_pyramid_;
  GeometricPoints geometric_points_;
  cv::Mat image_;
  double contrast_in_view_ = 0.0;
  Vector6 twist_per_period_ = Vector6::Zero();
  ShutterTimes shutter_;
};

}  // namespace mivo
