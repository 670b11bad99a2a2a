// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "mivo/core/camera.h"
#include "ros/image_conversion.h"

namespace mivo {

/// Depth in another size than color's, by a whole factor: CV_32FC1 in meters, of the size of the
/// color image. Where four readings lie on one surface what is between them lies on its plane,
/// elsewhere the nearest one is taken. Nothing is done, and the image returned, for equal sizes or
/// another ratio.
DepthImage enlargeDepth(const DepthImage& depth, const cv::Size& size);

/// Depth of a camera beside the color camera, as the color camera sees it: each reading becomes a
/// point, and of those that fall on a pixel the nearest counts, for it hides the others (as
/// depth_image_proc/register does it).
class DepthRegistration {
 public:
  /// @param T_color_depth  pose of the depth camera in the color camera
  /// Throws Error when the image has not the size of its camera.
  DepthImage toColor(const DepthImage& depth, const Camera& depth_camera,
                     const Camera& color_camera, const Eigen::Isometry3d& T_color_depth);

 private:
  void findRays(const Camera& depth_camera);

  Camera camera_;                      // of the rays
  std::vector<Eigen::Vector3f> rays_;  // of depth 1; z is 0 where the lens has none
};

}  // namespace mivo
