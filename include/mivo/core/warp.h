// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "mivo/core/camera.h"
#include "mivo/core/reference_points.h"

namespace mivo {

/// Where the points of a level fall in the live image, and what they see there. One entry per
/// point.
struct LiveSamples {
  std::vector<float> intensity;        ///< bilinear, grey levels; 0 where not visible
  std::vector<unsigned char> visible;  ///< 1: in front of the camera and inside of the image
  std::size_t num_visible = 0;
};

/// The warp of section II-B: samples a level of the live image at π(T X) for every point.
class Warp {
 public:
  /// @param camera the live camera of this level. @param threads see the parameter.
  Warp(const Camera& camera, int threads);

  /// @param image CV_32FC1, this level of the live image
  void sample(const ReferencePoints& points, const Eigen::Isometry3d& T_live_ref,
              const cv::Mat& image, LiveSamples& samples) const;

 private:
  struct Projection;
  std::size_t sampleChunk(const ReferencePoints& points, const Eigen::Isometry3d& T_live_ref,
                          const cv::Mat& image, std::size_t begin, std::size_t end,
                          LiveSamples& samples) const;

  Camera camera_;
  float max_squared_radius_;
  bool is_distorted_;
  int threads_;
};

}  // namespace mivo
