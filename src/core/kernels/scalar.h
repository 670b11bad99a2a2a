// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/kernels/kernels.h"

// The reference: each kernel in plain C++. The vector kernels call it for the last points of an
// array, which do not fill a vector.

namespace mivo {
namespace kernels {
namespace reference {

std::size_t warpPoints(const WarpParameters& parameters, const PointsView& points, std::size_t n,
                       float* u, float* v, float* visible);
void sampleIntensity(const ImageView& image, const float* u, const float* v, const float* visible,
                     std::size_t n, float* intensity);
std::size_t sampleNormalized(const ImageView& image, const ContrastView& contrast, float saturation,
                             const float* u, const float* v, float* visible, std::size_t n,
                             float* normalized);

void residuals(const float* live, const float* contrast, const float* reference,
               const float* visible, std::size_t n, float* residual);
void robustWeights(RobustWeight kind, float scale, const float* residual, const float* visible,
                   std::size_t n, float* weight);

double robustCost(RobustWeight kind, float scale, const float* residual, const float* visible,
                  std::size_t n);
void accumulateLeastSquares(RobustWeight kind, float scale, const float* residual,
                            const float* visible, const float* const jacobian[6], std::size_t n,
                            LeastSquaresSums& sums);
void accumulateScores(RobustWeight kind, float scale, const float* residual, const float* visible,
                      const float* const jacobian[6], const float* u, const float* v, std::size_t n,
                      const BlockGrid& grid, BlockScore* blocks);
void sumPairs(const float* a, const float* b, const float* divisor, const float* visible,
              std::size_t n, PairSums& sums);
std::size_t geometricResiduals(const WarpParameters& live, const Motion& T_ref_live,
                               const PlanesView& planes, const DepthView& depth, const float* u,
                               const float* v, std::size_t n, float* visible, float* residual,
                               float* const jacobian[6]);

void binPositions(const float* value, std::size_t n, float low, float scale, float top,
                  std::int32_t* bin, float* fraction);
void jointHistogram(const BinsView& reference, const BinsView& live, const float* visible,
                    std::size_t n, int side, float* scratch, double* sums);
void logarithms(const double* value, std::size_t n, double* logarithm);
void miDerivatives(const BinsView& reference, const BinsView& live, const float* active,
                   const float* jacobian_rows, const float* const jacobian[6],
                   const float* const second_derivative[21], std::size_t n, int side,
                   float bin_scale, const float* log_ratio, float* rows, MiSums& sums);

void keyframePoints(const WarpParameters& camera, const PixelsView& pixels, std::size_t n,
                    const DerivedPoints& points, double pixel_motion[21]);

void depthRow(const DepthView& depth, int y, int first, int width, float lowest, float highest,
              float* meters);
void reduceDepthRow(const DepthRows& fine, int width, float ratio, int first, float* coarse);
void keepSmooth(const float* const depth[3], int width, float edge_ratio, int first,
                std::uint8_t* candidates);

void reduce(const ImageView& fine, float* coarse, std::ptrdiff_t coarse_stride, float* scratch);
void smooth(const ImageView& image, std::uint8_t largest, std::uint8_t* smoothed,
            std::ptrdiff_t smoothed_stride, float* scratch);
double contrastMap(const ImageView& image, float* pairs, std::ptrdiff_t pairs_stride,
                   float* scratch);
void normalizeImage(const ImageView& image, const ContrastView& contrast,
                    const NormalizeParameters& parameters, float* normalized,
                    std::ptrdiff_t normalized_stride, float* scratch);
void gradientRow(const ImageView& image, int y, float* squared);
void maximaRow(const ImageView& image, int y, const float* const squared[3], float threshold,
               std::uint8_t* maximal);

// As the kernels of these names, but from column `first` >= 1 on.
void gradientTail(const ImageView& image, int y, int first, float* squared);
void maximaTail(const ImageView& image, int y, const float* const squared[3], float threshold,
                int first, std::uint8_t* maximal);

}  // namespace reference
}  // namespace kernels
}  // namespace mivo
