// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "mivo/core/parameters.h"

// The hot loops of the tracker as functions over plain float arrays. All arrays of one call have n
// entries unless said otherwise, may start at any address and must not overlap. `visible` is 1 for
// a point that takes part and 0 for one that does not.

namespace mivo {
namespace kernels {

/// Rows of floats, `stride` floats apart.
struct ImageView {
  const float* data;
  std::ptrdiff_t stride;
  int width;
  int height;
};

/// Points as a structure of arrays, metres.
struct PointsView {
  const float* x;
  const float* y;
  const float* z;
};

/// Motion of the points and projection into a level. A point X goes to q = R X + t; if rows are
/// read one after the other, to q' = q + tau (angular x q + linear) with tau = v / height - 0.5 for
/// the row v that q projects to; and then through the lens.
struct WarpParameters {
  float rotation[9];     ///< row by row
  float translation[3];  ///< m
  bool has_row_motion;
  float angular[3];  ///< rad during the read-out
  float linear[3];   ///< m during the read-out
  float height;      ///< pixels of the level
  float fx, fy, cx, cy;
  bool is_distorted;
  float k1, k2, p1, p2, k3;
  float max_squared_radius;  ///< of undistorted normalised coordinates
  float right, bottom;       ///< visible: 0 <= u < right, 0 <= v < bottom
};

/// Pixels of the points, and whether they are in front of the camera and inside; pixels of
/// invisible points are 0. Returns the number of visible ones.
std::size_t warpPoints(const WarpParameters& parameters, const PointsView& points, std::size_t n,
                       float* u, float* v, float* visible);

/// Bilinear intensity at the pixels; 0 where not visible.
void sampleIntensity(const ImageView& image, const float* u, const float* v, const float* visible,
                     std::size_t n, float* intensity);

/// Locally normalised intensity (I - mean) / (deviation + constant). The maps are reduced to a
/// quarter of the image's side: pixel (u, v) lies at (u / 4, v / 4). 0 where not visible.
void sampleNormalised(const ImageView& image, const ImageView& mean, const ImageView& deviation,
                      float constant, const float* u, const float* v, const float* visible,
                      std::size_t n, float* normalised);

/// residual = contrast * live - reference, 0 where not visible.
void residuals(const float* live, const float* contrast, const float* reference,
               const float* visible, std::size_t n, float* residual);

/// Sum of robust losses of the visible residuals, see robustLoss.
double robustCost(RobustWeight kind, float scale, const float* residual, const float* visible,
                  std::size_t n);

/// Sums of weighted least squares over the visible residuals, with the robust weights w:
/// hessian (upper triangle row by row) = sum w J Jᵀ, gradient = sum w J r.
struct LeastSquaresSums {
  double hessian[21];
  double gradient[6];
};
void accumulateLeastSquares(RobustWeight kind, float scale, const float* residual,
                            const float* visible, const float* const jacobian[6], std::size_t n,
                            LeastSquaresSums& sums);

}  // namespace kernels
}  // namespace mivo
