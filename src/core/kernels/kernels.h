// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/kernels/image_view.h"
#include "mivo/core/parameter_choices.h"

// The hot loops of the tracker as functions over plain arrays, once in plain C++ (the reference)
// and once with vector instructions, which the processor decides on at run time. All arrays of one
// call have n entries unless said otherwise, may start at any address and must not overlap.
// `visible` is 1 for a point that takes part and 0 for one that does not.

namespace mivo {
namespace kernels {

/// Points as a structure of arrays, meters.
struct PointsView {
  const float* x;
  const float* y;
  const float* z;
};

/// What a lens does to normalized coordinates, see Distortion. The first has no coefficients, the
/// second no k4 to k6.
enum class Lens { kNone, kPlumbBob, kRational, kEquidistant };

/// Motion of the points and projection into a level. A point X goes to q = R X + t; if rows are
/// read one after the other, to q' = q + tau (angular x q + linear) with the time
/// tau = v row_duration + first_row of the row v that q projects to; and then through the lens.
struct WarpParameters {
  float rotation[9];     ///< row by row
  float translation[3];  ///< m
  bool has_row_motion;
  float angular[3];    ///< rad per frame period
  float linear[3];     ///< m per frame period
  float row_duration;  ///< frame periods from one row of the level to the next
  float first_row;     ///< frame periods from the time of the pose to that of row 0
  float fx, fy, cx, cy;
  Lens lens;
  float k1, k2, p1, p2, k3, k4, k5, k6;
  float max_squared_radius;  ///< of undistorted normalized coordinates
  float right, bottom;       ///< visible: 0 <= u < right, 0 <= v < bottom
};

/// Sums of weighted least squares: hessian (upper triangle row by row) = sum w J Jᵀ,
/// gradient = sum w J r, and of the weights and curvatures of the losses.
struct LeastSquaresSums {
  double hessian[21];
  double gradient[6];
  double weight;
  double curvature;
};

/// Sums of pairs of numbers (a, b) and of their products.
struct PairSums {
  double a, b, aa, bb, ab;
};

/// Points on planes with unit normals, and what a residual along the normal is multiplied by.
struct PlanesView {
  PointsView point;
  PointsView normal;
  const float* weight;
};

/// Pixels of a keyframe and what its image does there.
struct PixelsView {
  const float* u;
  const float* v;
  const float* z;           ///< depth, m
  const float* gradient_u;  ///< gray levels per pixel
  const float* gradient_v;
  const float* curvature_uu;  ///< second derivatives; all three null unless asked for
  const float* curvature_uv;
  const float* curvature_vv;

  PixelsView from(std::size_t begin) const {
    const auto later = [=](const float* values) {
      return values != nullptr ? values + begin : nullptr;
    };
    return {u + begin,          v + begin,           z + begin,           gradient_u + begin,
            gradient_v + begin, later(curvature_uu), later(curvature_uv), later(curvature_vv)};
  }
};

/// Where keyframePoints puts its results, see ReferencePoints.
struct DerivedPoints {
  float* x;
  float* y;
  float* z;
  float* jacobian[6];
  float* second_derivative[21];  ///< not used without the image's second derivatives

  DerivedPoints from(std::size_t begin) const {
    DerivedPoints rest = {x + begin, y + begin, z + begin, {}, {}};
    for (int k = 0; k < 6; ++k) rest.jacobian[k] = jacobian[k] + begin;
    for (int k = 0; k < 21; ++k) {
      if (second_derivative[k] != nullptr) rest.second_derivative[k] = second_derivative[k] + begin;
    }
    return rest;
  }
};

/// The two or three rows of a depth image around one of them, meters, 0 for no reading.
struct DepthRows {
  const float* row[3];
  int count;
  int middle;  ///< index of the row in the middle
};

/// A row-major rigid motion.
struct Motion {
  float rotation[9];
  float translation[3];
};

/// Positions on the axis of bins: bin + fraction, 0 <= fraction < 1.
struct BinsView {
  const std::int32_t* bin;
  const float* fraction;
};

/// What the derivatives of mutual information sum up; see mi_derivatives.cpp for the symbols. In
/// derivatives with respect to the increment, of intensities in gray levels.
struct MiSums {
  double gradient[6];    ///< sum of g J
  double curvature[21];  ///< sum of s h J Jᵀ + g S, upper triangle row by row
};

/// Floats per row of the table of dp_rl, and of a point's Jacobian in rows: 6 and two zeros.
constexpr int kRowFloats = 8;

/// An image cut into blocks, row by row: pixel (u, v) lies in block
/// floor(v per_pixel) columns + floor(u per_pixel).
struct BlockGrid {
  float per_pixel;  ///< blocks per pixel
  int columns;
};

/// Sum over the visible points of a block: of weight times residual times Jacobian, and how many
/// they are.
struct BlockScore {
  float score[kRowFloats];  ///< six, the number of points, and a zero
};

struct Kernels {
  /// Pixels of the points, and whether they are in front of the camera and inside; pixels of
  /// invisible points are 0. Returns the number of visible ones.
  std::size_t (*warpPoints)(const WarpParameters& parameters, const PointsView& points,
                            std::size_t n, float* u, float* v, float* visible);

  /// Bilinear intensity at pixels as warpPoints leaves them; 0 where not visible.
  void (*sampleIntensity)(const ImageView& image, const float* u, const float* v,
                          const float* visible, std::size_t n, float* intensity);

  /// Locally normalized intensity (I - mean) / (deviation + constant), see ContrastView; 0 where
  /// not visible. A point whose intensity reaches `saturation` is visible no longer: what is
  /// clipped cannot be normalized. Returns the number of those hidden.
  std::size_t (*sampleNormalized)(const ImageView& image, const ContrastView& contrast,
                                  float saturation, const float* u, const float* v, float* visible,
                                  std::size_t n, float* normalized);

  /// residual = contrast * live - reference, 0 where not visible.
  void (*residuals)(const float* live, const float* contrast, const float* reference,
                    const float* visible, std::size_t n, float* residual);

  /// Sum of robust losses of the visible residuals, see robustLoss.
  double (*robustCost)(RobustWeight kind, float scale, const float* residual, const float* visible,
                       std::size_t n);

  /// Robust weights of the visible residuals, see robustLoss; 0 where not visible.
  void (*robustWeights)(RobustWeight kind, float scale, const float* residual, const float* visible,
                        std::size_t n, float* weight);

  /// With the robust weights of the visible residuals.
  void (*accumulateLeastSquares)(RobustWeight kind, float scale, const float* residual,
                                 const float* visible, const float* const jacobian[6],
                                 std::size_t n, LeastSquaresSums& sums);

  /// Adds each visible point to the block of the image that it lies in, see robustLoss for the
  /// weight. @param u, v pixels; what is not visible lies somewhere in the image, too.
  void (*accumulateScores)(RobustWeight kind, float scale, const float* residual,
                           const float* visible, const float* const jacobian[6], const float* u,
                           const float* v, std::size_t n, const BlockGrid& grid,
                           BlockScore* blocks);

  /// Sums over the visible points of a and b / divisor.
  void (*sumPairs)(const float* a, const float* b, const float* divisor, const float* visible,
                   std::size_t n, PairSums& sums);

  /// Point to plane, r = weight n . (T_ref_live Y - X): Y is the reading where X falls, at the
  /// pixel nearest to (u, v). `visible`: on input whether the point is in view, on output whether
  /// it has a reading. The Jacobian is that of r(d) = r - J d for the increment d of the keyframe.
  /// Returns the number of visible ones.
  std::size_t (*geometricResiduals)(const WarpParameters& live, const Motion& T_ref_live,
                                    const PlanesView& planes, const DepthView& depth,
                                    const float* u, const float* v, std::size_t n, float* visible,
                                    float* residual, float* const jacobian[6]);

  /// position = (value - low) * scale, held within 0..top, split into bin and fraction.
  void (*binPositions)(const float* value, std::size_t n, float low, float scale, float top,
                       std::int32_t* bin, float* fraction);

  /// Adds the visible pairs' products of B-spline weights to sums[side * side], row = bin of the
  /// reference: bins are 0..side - 4 and touch 4 entries from there. @param scratch
  /// histogramScratch(side) floats.
  void (*jointHistogram)(const BinsView& reference, const BinsView& live, const float* visible,
                         std::size_t n, int side, float* scratch, double* sums);

  /// Natural logarithms; 0 for what is not positive.
  void (*logarithms)(const double* value, std::size_t n, double* logarithm);

  /// Adds dp_rl, without the scale s and 1/n, to rows[side * side * kRowFloats], and sets the sums.
  /// @param active 1 for a point that counts. @param log_ratio side * side: log(p_rl / p_r).
  /// @param jacobian_rows n * kRowFloats. @param bin_scale s, bins per gray level.
  void (*miDerivatives)(const BinsView& reference, const BinsView& live, const float* active,
                        const float* jacobian_rows, const float* const jacobian[6],
                        const float* const second_derivative[21], std::size_t n, int side,
                        float bin_scale, const float* log_ratio, float* rows, MiSums& sums);

  /// 5 x 5 Gaussian that keeps the even pixels, as cv::pyrDown: `coarse` has (width + 1) / 2
  /// columns and (height + 1) / 2 rows. @param scratch imageScratch(width) floats.
  void (*reduce)(const ImageView& fine, float* coarse, std::ptrdiff_t coarse_stride,
                 float* scratch);

  /// Bytes under the 3 x 3 binomial (1, 2, 1), mirrored at the border and rounded to the nearest;
  /// left as they are where one of the nine is above `largest`: what is clipped tells nothing.
  /// @param image of bytes, 2 x 2 pixels at least @param scratch imageScratch(width) floats.
  void (*smooth)(const ImageView& image, std::uint8_t largest, std::uint8_t* smoothed,
                 std::ptrdiff_t smoothed_stride, float* scratch);

  /// Mean and standard deviation over 5 x 5 pixels, mirrored at the border, as pairs. The image is
  /// of floats and has at least 3 x 3 pixels. Returns the sum of the variances. @param scratch
  /// imageScratch(width) floats.
  double (*contrastMap)(const ImageView& image, float* pairs, std::ptrdiff_t pairs_stride,
                        float* scratch);

  /// A whole image normalized and scaled: clamp(middle + gain * (I - mean) / (deviation +
  /// constant), 0, white). @param scratch imageScratch(width) floats.
  void (*normalizeImage)(const ImageView& image, const ContrastView& contrast,
                         const NormalizeParameters& parameters, float* normalized,
                         std::ptrdiff_t normalized_stride, float* scratch);

  /// One row of squared gradients of central differences, for 1 <= x < n - 1; 0 at both ends.
  void (*gradientRow)(const ImageView& image, int y, float* squared);

  /// Where a row of squared gradients is at least `threshold`, positive, and maximal among the two
  /// neighbors in the gradient's direction, rounded to one of four; of two equal neighbors the
  /// later one counts. One byte per pixel, for 2 <= x < width - 2; 0 elsewhere. @param squared
  /// those of the rows y - 1, y, y + 1.
  void (*maximaRow)(const ImageView& image, int y, const float* const squared[3], float threshold,
                    std::uint8_t* maximal);

  /// One row of readings in meters, from column `first` on; 0 for those outside of lowest..highest.
  void (*depthRow)(const DepthView& depth, int y, int first, int width, float lowest, float highest,
                   float* meters);

  /// One row of half the width, rounded up, from its column `first` on: 0 where the reading in the
  /// middle is none, otherwise the mean of those of the 3 x 3 readings around it that differ from
  /// it by at most `ratio` of it. The rows have `width` entries.
  void (*reduceDepthRow)(const DepthRows& fine, int width, float ratio, int first, float* coarse);

  /// Sets to 0 what is not on a smooth surface, for 1 <= first <= x < width - 1: where one of the
  /// 3 x 3 readings is missing, or they span more than `edge_ratio` of that in the middle.
  /// @param candidates bytes, 0 or 1
  void (*keepSmooth)(const float* const depth[3], int width, float edge_ratio, int first,
                     std::uint8_t* candidates);

  /// Points of a keyframe, moved to where they were when the middle row was read, with the first
  /// and, where the image's second derivatives are given, second derivatives of their intensity
  /// with respect to the increment. Adds to pixel_motion the upper triangle, row by row, of the sum
  /// of JᵀJ, J = d pixel / d increment. @param camera the pose in it does not matter.
  void (*keyframePoints)(const WarpParameters& camera, const PixelsView& pixels, std::size_t n,
                         const DerivedPoints& points, double pixel_motion[21]);
};

/// Floats that jointHistogram needs.
inline std::size_t histogramScratch(int side) {
  const auto cells = static_cast<std::size_t>(side - 3) * static_cast<std::size_t>(side - 3);
  return 2 * 16 * cells;
}

/// Floats that the kernels of whole images need for rows of a width.
inline std::size_t imageScratch(int width) {
  return 4 * (static_cast<std::size_t>(width) + 64);
}

/// The reference.
const Kernels& scalar();

struct Backend {
  std::string name;  ///< "scalar", or the instruction set: SSE4, AVX2, AVX3 (AVX-512), NEON
  const Kernels* kernels;
};

/// What this processor can run, the reference first, the fastest last.
std::vector<Backend> backends();

/// The kernels in use: the fastest, unless another was chosen.
const Kernels& active();
std::string activeName();

/// Uses a backend by its name, or the fastest by "auto", in the whole process. Throws Error with
/// the names there are for another one. Not while a frame is processed.
void select(const std::string& name);

}  // namespace kernels
}  // namespace mivo
