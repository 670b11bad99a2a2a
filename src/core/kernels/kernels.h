// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/kernels/image_view.h"
#include "mivo/core/parameter_choices.h"

// The hot loops of the tracker as functions over plain arrays. Each exists in plain C++ (the
// reference) and with the vector instructions of several processors; the processor's are selected
// at run time. All arrays of a call have n entries unless stated otherwise, need no alignment and
// must not overlap. `visible` is 1 for a point that is used and 0 for one that is not.

namespace mivo {
namespace kernels {

/// Points as a structure of arrays, meters.
struct PointsView {
  const float* x;
  const float* y;
  const float* z;
};

/// The distortion of normalized coordinates by a lens, see Distortion. kNone has no coefficients,
/// kPlumbBob no k4 to k6.
enum class Lens { kNone, kPlumbBob, kRational, kEquidistant };

/// Motion of the points and projection into a pyramid level. A point X moves to q = R X + t. With a
/// rolling shutter it moves to q' = q + tau (angular x q + linear), where
/// tau = v row_duration + first_row is the read-out time of the row v that q projects to. The
/// result is distorted by the lens and projected.
struct WarpParameters {
  float rotation[9];     ///< row by row
  float translation[3];  ///< m
  bool has_row_motion;
  float angular[3];    ///< rad per frame period
  float linear[3];     ///< m per frame period
  float row_duration;  ///< time from one row of the level to the next, frame periods
  float first_row;     ///< time from the pose to row 0, frame periods
  float fx, fy, cx, cy;
  Lens lens;
  float k1, k2, p1, p2, k3, k4, k5, k6;
  float max_squared_radius;  ///< of undistorted normalized coordinates
  float right, bottom;       ///< visible: 0 <= u < right, 0 <= v < bottom
};

/// Sums of weighted least squares: hessian = sum w J Jᵀ (upper triangle, row by row),
/// gradient = sum w J r, the sum of the weights and that of the curvatures of the losses.
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

/// Points on planes, with unit normals and the weights of the residuals along the normals.
struct PlanesView {
  PointsView point;
  PointsView normal;
  const float* weight;
};

/// Pixels of a keyframe, with depth and the derivatives of the image.
struct PixelsView {
  const float* u;
  const float* v;
  const float* z;           ///< depth, m
  const float* gradient_u;  ///< gray levels per pixel
  const float* gradient_v;
  const float* curvature_uu;  ///< second derivatives; all three are null if not needed
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

/// The output of keyframePoints, see ReferencePoints.
struct DerivedPoints {
  float* x;
  float* y;
  float* z;
  float* jacobian[6];
  float* second_derivative[21];  ///< unused without second derivatives of the image

  DerivedPoints from(std::size_t begin) const {
    DerivedPoints rest = {x + begin, y + begin, z + begin, {}, {}};
    for (int k = 0; k < 6; ++k) rest.jacobian[k] = jacobian[k] + begin;
    for (int k = 0; k < 21; ++k) {
      if (second_derivative[k] != nullptr) rest.second_derivative[k] = second_derivative[k] + begin;
    }
    return rest;
  }
};

/// A row of a depth image with its two neighbors, or with one at the border. Meters, 0: no reading.
struct DepthRows {
  const float* row[3];
  int count;
  int middle;  ///< index of the row in the middle
};

/// A rigid motion; the rotation is row-major.
struct Motion {
  float rotation[9];
  float translation[3];
};

/// Positions on the axis of the histogram bins: bin + fraction, 0 <= fraction < 1.
struct BinsView {
  const std::int32_t* bin;
  const float* fraction;
};

/// The sums in the derivatives of mutual information with respect to the pose increment; see
/// mi_derivatives.cpp for the symbols. Intensities are in gray levels.
struct MiSums {
  double gradient[6];    ///< sum of g J
  double curvature[21];  ///< sum of s h J Jᵀ + g S, upper triangle row by row
};

/// Floats in a row of the table of dp_rl and in a row that contains a point's Jacobian: 6, and two
/// zeros as padding.
constexpr int kRowFloats = 8;

/// An image divided into blocks, numbered row by row: pixel (u, v) is in block
/// floor(v per_pixel) columns + floor(u per_pixel).
struct BlockGrid {
  float per_pixel;  ///< blocks per pixel
  int columns;
};

/// Sums over the visible points of a block: weight times residual times Jacobian, and the number of
/// points.
struct BlockScore {
  float score[kRowFloats];  ///< six sums, the number of points, and a zero as padding
};

struct Kernels {
  /// Projects the points. Visible are those in front of the camera and inside the image; the others
  /// get the pixel (0, 0). Returns the number of visible points.
  std::size_t (*warpPoints)(const WarpParameters& parameters, const PointsView& points,
                            std::size_t n, float* u, float* v, float* visible);

  /// Bilinear interpolation of the intensity at the pixels of warpPoints; 0 for invisible points.
  void (*sampleIntensity)(const ImageView& image, const float* u, const float* v,
                          const float* visible, std::size_t n, float* intensity);

  /// Locally normalized intensity (I - mean) / (deviation + constant), see ContrastView; 0 for
  /// invisible points. Points whose intensity reaches `saturation` become invisible, since clipped
  /// intensities cannot be normalized. Returns their number.
  std::size_t (*sampleNormalized)(const ImageView& image, const ContrastView& contrast,
                                  float saturation, const float* u, const float* v, float* visible,
                                  std::size_t n, float* normalized);

  /// residual = contrast * live - reference; 0 for invisible points.
  void (*residuals)(const float* live, const float* contrast, const float* reference,
                    const float* visible, std::size_t n, float* residual);

  /// Sum of the robust losses of the visible residuals, see robustLoss.
  double (*robustCost)(RobustWeight kind, float scale, const float* residual, const float* visible,
                       std::size_t n);

  /// Robust weights of the residuals, see robustLoss; 0 for invisible points.
  void (*robustWeights)(RobustWeight kind, float scale, const float* residual, const float* visible,
                        std::size_t n, float* weight);

  /// Adds the visible residuals with their robust weights to the sums.
  void (*accumulateLeastSquares)(RobustWeight kind, float scale, const float* residual,
                                 const float* visible, const float* const jacobian[6],
                                 std::size_t n, LeastSquaresSums& sums);

  /// Adds each visible point to its block of the image; for the weight see robustLoss.
  /// @param u, v pixels inside the image, also of invisible points.
  void (*accumulateScores)(RobustWeight kind, float scale, const float* residual,
                           const float* visible, const float* const jacobian[6], const float* u,
                           const float* v, std::size_t n, const BlockGrid& grid,
                           BlockScore* blocks);

  /// Sums of the pairs (a, b / divisor) over the visible points.
  void (*sumPairs)(const float* a, const float* b, const float* divisor, const float* visible,
                   std::size_t n, PairSums& sums);

  /// Point-to-plane residuals r = weight n . (T_ref_live Y - X). Y is the live point at the pixel
  /// nearest to (u, v), the projection of X. `visible` is on input whether the point is in view, on
  /// output whether it has a depth reading, too. The Jacobian is defined by r(d) = r - J d for the
  /// pose increment d of the keyframe. Returns the number of visible points.
  std::size_t (*geometricResiduals)(const WarpParameters& live, const Motion& T_ref_live,
                                    const PlanesView& planes, const DepthView& depth,
                                    const float* u, const float* v, std::size_t n, float* visible,
                                    float* residual, float* const jacobian[6]);

  /// position = (value - low) * scale, clamped to 0..top and split into bin and fraction.
  void (*binPositions)(const float* value, std::size_t n, float low, float scale, float top,
                       std::int32_t* bin, float* fraction);

  /// Joint histogram: adds the products of the B-spline weights of each visible pair to
  /// sums[side * side], whose rows are the bins of the reference. Bins are 0..side - 4; a sample
  /// contributes to 4 entries from its bin on. @param scratch histogramScratch(side) floats.
  void (*jointHistogram)(const BinsView& reference, const BinsView& live, const float* visible,
                         std::size_t n, int side, float* scratch, double* sums);

  /// Natural logarithms; 0 for values that are not positive.
  void (*logarithms)(const double* value, std::size_t n, double* logarithm);

  /// Adds dp_rl, without the scale s and 1/n, to rows[side * side * kRowFloats], and sets the sums.
  /// @param active 1 for a point that is used, 0 otherwise. @param log_ratio side * side: log(p_rl
  /// / p_r).
  /// @param jacobian_rows n * kRowFloats. @param bin_scale s, bins per gray level.
  void (*miDerivatives)(const BinsView& reference, const BinsView& live, const float* active,
                        const float* jacobian_rows, const float* const jacobian[6],
                        const float* const second_derivative[21], std::size_t n, int side,
                        float bin_scale, const float* log_ratio, float* rows, MiSums& sums);

  /// 5 x 5 Gaussian at the even pixels, as cv::pyrDown. `coarse` has (width + 1) / 2
  /// columns and (height + 1) / 2 rows. @param scratch imageScratch(width) floats.
  void (*reduce)(const ImageView& fine, float* coarse, std::ptrdiff_t coarse_stride,
                 float* scratch);

  /// Smooths with the 3 x 3 binomial kernel (1, 2, 1), mirrored at the border and rounded to the
  /// nearest. A pixel stays unchanged if one of its 3 x 3 pixels is above `largest`: clipped
  /// intensities are unknown. @param image bytes, at least 2 x 2 pixels
  /// @param scratch imageScratch(width) floats.
  void (*smooth)(const ImageView& image, std::uint8_t largest, std::uint8_t* smoothed,
                 std::ptrdiff_t smoothed_stride, float* scratch);

  /// Pairs of mean and standard deviation over 5 x 5 pixels, mirrored at the border. Returns the
  /// sum of the variances. @param image floats, at least 3 x 3 pixels
  /// @param scratch imageScratch(width) floats.
  double (*contrastMap)(const ImageView& image, float* pairs, std::ptrdiff_t pairs_stride,
                        float* scratch);

  /// Normalizes and scales a whole image: clamp(middle + gain * (I - mean) / (deviation +
  /// constant), 0, white). @param scratch imageScratch(width) floats.
  void (*normalizeImage)(const ImageView& image, const ContrastView& contrast,
                         const NormalizeParameters& parameters, float* normalized,
                         std::ptrdiff_t normalized_stride, float* scratch);

  /// One row of squared gradients (central differences) for 1 <= x < width - 1; 0 at both ends.
  void (*gradientRow)(const ImageView& image, int y, float* squared);

  /// Non-maximum suppression along one row. A pixel is 1 if its squared gradient is positive, at
  /// least `threshold`, and maximal compared with its two neighbors in the direction of the
  /// gradient, rounded to one of four; of equal neighbors the later one is kept. One byte per pixel
  /// for 2 <= x < width - 2; 0 elsewhere. @param squared squared gradients of the rows y - 1, y, y
  /// + 1.
  void (*maximaRow)(const ImageView& image, int y, const float* const squared[3], float threshold,
                    std::uint8_t* maximal);

  /// Converts a row of readings to meters from column `first` on; 0 for those outside
  /// lowest..highest.
  void (*depthRow)(const DepthView& depth, int y, int first, int width, float lowest, float highest,
                   float* meters);

  /// Halves a row of depth from column `first` of the coarse row on; the fine rows have `width`
  /// entries, the coarse one (width + 1) / 2. An entry is the mean of the 3 x 3 readings that
  /// differ from the one in the middle by at most `ratio` of it; 0 if the middle has no reading.
  void (*reduceDepthRow)(const DepthRows& fine, int width, float ratio, int first, float* coarse);

  /// Rejects candidates at depth edges, for 1 <= first <= x < width - 1: sets those to 0 that lack
  /// one of the 3 x 3 readings, or whose readings span more than `edge_ratio` of the one in the
  /// middle.
  /// @param candidates bytes, 0 or 1
  void (*keepSmooth)(const float* const depth[3], int width, float edge_ratio, int first,
                     std::uint8_t* candidates);

  /// Points of a keyframe at the time its middle row was read, with the first derivatives of their
  /// intensity with respect to the pose increment, and with the second ones if those of the image
  /// are given. Adds the sum of JᵀJ, J = d pixel / d increment, to pixel_motion (upper triangle,
  /// row by row). @param camera its pose is not used.
  void (*keyframePoints)(const WarpParameters& camera, const PixelsView& pixels, std::size_t n,
                         const DerivedPoints& points, double pixel_motion[21]);
};

/// Number of floats that jointHistogram needs as scratch.
inline std::size_t histogramScratch(int side) {
  const auto cells = static_cast<std::size_t>(side - 3) * static_cast<std::size_t>(side - 3);
  return 2 * 16 * cells;
}

/// Number of floats that the kernels of whole images need as scratch.
inline std::size_t imageScratch(int width) {
  return 4 * (static_cast<std::size_t>(width) + 64);
}

/// The kernels in plain C++, the reference.
const Kernels& scalar();

struct Backend {
  std::string name;  ///< "scalar", or the instruction set: SSE4, AVX2, AVX3 (AVX-512), NEON
  const Kernels* kernels;
};

/// The backends this processor supports: the reference first, the fastest last.
std::vector<Backend> backends();

/// The kernels in use: the fastest, unless select() chose others.
const Kernels& active();
std::string activeName();

/// Selects a backend by name for the whole process; "auto" selects the fastest. Throws Error with
/// the known names if there is none of that name. Must not be called while a frame is processed.
void select(const std::string& name);

}  // namespace kernels
}  // namespace mivo
