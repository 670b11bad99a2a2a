// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/row_motion.h"
#include "core/images/contrast_maps.h"
#include "core/kernels/kernels.h"
#include "core/keyframe/reference_points.h"
#include "mivo/core/camera.h"

namespace mivo {

/// Projections of the points of a level into the live image, and sampled values. One entry per
/// point.
struct LiveSamples {
  std::vector<float> u, v;     ///< pixels of the level; 0 where not visible
  std::vector<float> visible;  ///< 1: in view and not saturated; otherwise 0
  std::vector<float> value;    ///< intensity or normalized intensity; 0 where not visible
  std::size_t num_visible = 0;
  std::size_t num_in_view = 0;  ///< in front of the camera and inside of the image
};

/// The warp of section II-B with the read-out time of each row: samples a level of the live image
/// at π(T X) for every point.
class Warp {
 public:
  /// @param camera the live camera of this level. @param rows motion of the live camera while its
  /// rows are read. @param threads see the parameter.
  Warp(const Camera& camera, const RowMotion& rows, int threads);

  /// Bilinear samples of a CV_32FC1 or CV_8UC1 level, for the first `num_points` points.
  void sample(const ReferencePoints& points, std::size_t num_points,
              const Eigen::Isometry3d& T_live_ref, const cv::Mat& image,
              LiveSamples& samples) const;

  /// The same, normalized by `contrast`; points of at least `saturation` gray levels are hidden.
  void sampleNormalized(const ReferencePoints& points, std::size_t num_points,
                        const Eigen::Isometry3d& T_live_ref, const cv::Mat& image,
                        const ContrastMap& contrast, double saturation, LiveSamples& samples) const;

  const Camera& camera() const { return camera_; }
  const RowMotion& rows() const { return rows_; }

  /// The kernel's parameters for one pose.
  kernels::WarpParameters parameters(const Eigen::Isometry3d& T_live_ref) const;

 private:
  template <typename SampleChunk>
  void sampleChunks(const ReferencePoints& points, std::size_t num_points,
                    const Eigen::Isometry3d& T_live_ref, LiveSamples& samples,
                    const SampleChunk& sample_chunk) const;

  Camera camera_;
  RowMotion rows_;
  float max_radius_;  // of undistorted normalized coordinates
  int threads_;
};

}  // namespace mivo
