// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/row_motion.h"
#include "core/images/contrast_maps.h"
#include "core/kernels/kernels.h"
#include "core/keyframe/point_selection.h"
#include "mivo/core/camera.h"
#include "mivo/core/se3.h"

namespace mivo {

/// Number of distinct entries of a symmetric 6 x 6 matrix.
constexpr int kSymmetric6 = 21;

/// The points of one level of a keyframe and what depends on the keyframe alone (section II-E), as
/// a structure of arrays. The increment d = (v, w) warps a point X of the keyframe to exp(w) X + v.
struct ReferencePoints {
  int level = 0;
  std::vector<Pixel> pixels;
  /// Number of leading points, which come first: the strongest of each cell. They perform the
  /// iterations.
  std::size_t num_leading = 0;
  /// Meters, optical frame of the keyframe at the time of its middle row.
  std::vector<float> x, y, z;
  /// What the live image is compared with, gray levels: the intensity; with local contrast
  /// normalization the intensity minus its local mean.
  std::vector<float> intensity;
  /// Gray levels per unit of the live sample: 1; with local contrast normalization the local
  /// deviation, so that each point has the weight that its noise justifies.
  std::vector<float> contrast;
  std::array<std::vector<float>, 6> jacobian;  ///< d intensity / d d, gray levels per m and per rad
  /// Second derivative of the intensity, upper triangle row by row; empty unless asked for.
  std::array<std::vector<float>, kSymmetric6> second_derivative;
  float median_depth = 1.0F;  ///< m; 1 when there are no points
  /// Mean of JᵀJ of the pixel positions (2 x 6 Jacobians): dᵀ M d is the mean squared motion, in
  /// pixels of this level, of a small increment d.
  Matrix6 pixel_motion = Matrix6::Identity();

  std::size_t size() const { return pixels.size(); }
  kernels::PointsView view(std::size_t begin) const {
    return {x.data() + begin, y.data() + begin, z.data() + begin};
  }
};

/// The image that points are created from.
struct ReferenceImage {
  const cv::Mat& gray;                    ///< CV_32FC1, of the level
  const ContrastMap* contrast = nullptr;  ///< to normalize it by; null: taken as it is
};

/// The depth of the points.
struct ReferenceDepth {
  const cv::Mat& meters;  ///< CV_32FC1, of the level; 0 for none
  double offset = 0.0;    ///< frame periods by which a row of it is read later than of the image
};

/// Fills the arrays for the pixels of points.pixels, which have depth and lie at least one pixel
/// from the border of their level. @param camera of this level.
/// @param rows motion of the keyframe's camera while its rows were read: points are moved to where
/// they were when the middle row was read.
void makeReferencePoints(const ReferenceImage& image, const ReferenceDepth& depth,
                         const Camera& camera, const RowMotion& rows, bool with_second_derivative,
                         ReferencePoints& points);

}  // namespace mivo
