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

/// Reference of the alignment: the points of each level and derived data. The coarsest level uses
/// all pixels with depth, the others salient ones (section III-C).
class Keyframe {
 public:
  /// Fills the keyframe from a frame; buffers are reused. @param twist_per_period motion of the
  /// scene in the camera's axes per frame period.
  void build(const FramePyramid& frame, const Camera& camera, const Vector6& twist_per_period,
             const ShutterTimes& shutter, const Parameters& parameters);

  /// The two halves of build(), to distribute its time over two frames: selection of points, and
  /// computation of derived data. After the first half, image, depth and number of points are
  /// available.
  void choosePoints(const FramePyramid& frame, const Vector6& twist_per_period,
                    const ShutterTimes& shutter, const Parameters& parameters);
  /// Between the halves: selects points by depth alone if the image has less contrast than the last
  /// keyframe that was not dark, or too few salient points.
  void choosePointsByDepth(double last_lit_contrast, const Parameters& parameters);
  void finish(const FramePyramid& frame, const Camera& camera, const Parameters& parameters);

  /// See FramePyramid::contrastInView().
  double contrastInView() const { return contrast_in_view_; }

  const Vector6& twistPerPeriod() const { return twist_per_period_; }

  int numLevels() const { return static_cast<int>(levels_.size()); }
  const KeyframeLevel& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }

  /// Number of points on level 0.
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
