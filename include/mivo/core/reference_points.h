// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "mivo/core/camera.h"
#include "mivo/core/point_selection.h"
#include "mivo/core/se3.h"

namespace mivo {

/// Number of distinct entries of a symmetric 6 x 6 matrix.
constexpr int kSymmetric6 = 21;

/// The points of one level of a keyframe and what depends on the keyframe alone (section II-E), as
/// a structure of arrays. The increment d = (v, w) warps a point X of the keyframe to exp(w) X + v.
struct ReferencePoints {
  int level = 0;
  std::vector<Pixel> pixels;
  std::vector<float> x, y, z;                  ///< metres, optical frame of the keyframe
  std::vector<float> intensity;                ///< grey levels, 0..255
  std::array<std::vector<float>, 6> jacobian;  ///< d intensity / d d, grey levels per m and per rad
  /// Second derivative of the intensity, upper triangle row by row; empty unless asked for.
  std::array<std::vector<float>, kSymmetric6> second_derivative;
  float median_depth = 1.0F;  ///< m; 1 when there are no points
  /// Mean of JᵀJ of the pixel positions (2 x 6 Jacobians): dᵀ M d is the mean squared motion, in
  /// pixels of this level, of a small increment d.
  Matrix6 pixel_motion = Matrix6::Identity();

  std::size_t size() const { return pixels.size(); }
};

/// Fills the arrays for the chosen pixels of one level.
/// @param image CV_32FC1 grey, @param depth CV_32FC1 metres, both of this level; every pixel has
/// depth and lies at least one pixel from the border. @param camera of this level.
void makeReferencePoints(const cv::Mat& image, const cv::Mat& depth, const Camera& camera,
                         const std::vector<Pixel>& pixels, bool with_second_derivative,
                         ReferencePoints& points);

/// First and second derivative of the intensity at one point with respect to the increment, from
/// those with respect to undistorted normalised coordinates (X / Z, Y / Z).
struct PointDerivatives {
  Vector6 jacobian;
  Matrix6 second;
};
PointDerivatives pointDerivatives(const Eigen::Vector3d& point,
                                  const Eigen::Vector2d& normalised_gradient,
                                  const Eigen::Matrix2d& normalised_hessian);

}  // namespace mivo
