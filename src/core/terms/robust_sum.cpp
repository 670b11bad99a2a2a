// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/robust_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/execution/parallel_chunks.h"
#include "core/execution/recycled.h"
#include "core/kernels/kernels.h"
#include "core/terms/robust_weight.h"

namespace mivo {
namespace {

// Number of blocks per row of the image; points of a block are assumed to have common errors. At
// 640 x 480 there are about eighty blocks of 64 x 64 pixels, enough for a covariance of six
// numbers.
constexpr int kBlocksPerRow = 10;
// Standard deviation of a Gaussian in medians of its magnitude.
constexpr double kMedianToDeviation = 1.4826;

// Magnitudes are counted by the leading bits of their floats: 32 steps in each octave, over the
// octaves from 2^-10 to 2^14, and the two ends. The median is then among few.
constexpr int kStepBits = 5;
constexpr std::uint32_t kShift = 23 - kStepBits;
constexpr std::uint32_t kFirst = (127U - 10U) << kStepBits;
constexpr std::uint32_t kSteps = 24U << kStepBits;

std::uint32_t stepOf(float residual) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &residual, sizeof(bits));
  const std::uint32_t leading = (bits & 0x7FFFFFFFU) >> kShift;  // without the sign
  return leading < kFirst ? 0U : std::min(leading - kFirst, kSteps - 1U);
}

/// Least magnitude of a step.
float startOf(std::uint32_t step) {
  const std::uint32_t bits = (step + kFirst) << kShift;
  float magnitude = 0.0F;
  std::memcpy(&magnitude, &bits, sizeof(magnitude));
  return magnitude;
}

// This many residuals determine the scale to 2 %; of more, only every second, third, ... is used.
constexpr std::size_t kEnoughForScale = 4096;

/// Median of the magnitudes of the visible residuals to within half a step, a 64th of it; 0 if none
/// of the sampled ones is visible.
float medianMagnitude(const Residuals& residuals) {
  std::array<std::uint32_t, kSteps> counts{};
  const std::size_t n = residuals.value.size();
  const std::size_t stride = std::max<std::size_t>(1, n / kEnoughForScale);
  // Visibility is added instead of tested: the branch would be unpredictable.
  std::size_t num_visible = 0;
  for (std::size_t i = 0; i < n; i += stride) {
    const std::uint32_t is_visible = residuals.visible[i] != 0.0F ? 1U : 0U;
    counts[stepOf(residuals.value[i])] += is_visible;
    num_visible += is_visible;
  }
  if (num_visible == 0) return 0.0F;
  std::size_t rank = num_visible / 2;
  std::uint32_t step = 0;
  while (rank >= counts[step]) rank -= counts[step++];
  if (step == 0) return 0.0F;
  // Values within a step are assumed to be uniformly distributed.
  const float share = (static_cast<float>(rank) + 0.5F) / static_cast<float>(counts[step]);
  const float low = startOf(step);
  return low + share * (startOf(step + 1) - low);
}

/// The residual of the warped keyframe is r(d) = r - J d: the gradient is minus the sum of J r.
QuadraticModel toModel(const std::vector<kernels::LeastSquaresSums>& parts, double factor) {
  QuadraticModel model;
  for (const kernels::LeastSquaresSums& part : parts) {
    const double* entry = part.hessian;
    for (int row = 0; row < 6; ++row) {
      model.gradient[row] -= factor * part.gradient[row];
      for (int column = row; column < 6; ++column) {
        model.hessian(row, column) += factor * *entry++;
        model.hessian(column, row) = model.hessian(row, column);
      }
    }
  }
  return model;
}

/// Ratio of the losses' curvatures to the weights, at least that of Gaussian residuals, since
/// outliers may become inliers.
double curvatureShare(const std::vector<kernels::LeastSquaresSums>& parts, RobustWeight kind) {
  double weight = 0.0;
  double curvature = 0.0;
  for (const kernels::LeastSquaresSums& part : parts) {
    weight += part.weight;
    curvature += part.curvature;
  }
  return weight > 0.0 ? std::max(curvature / weight, gaussianCurvature(kind)) : 1.0;
}

}  // namespace

RobustSum::RobustSum(RobustWeight kind, double min_scale, const Parameters& parameters)
    : kind_(kind),
      min_scale_(min_scale),
      scale_iterations_(parameters.ssd.robust_scale_iterations),
      threads_(parameters.alignment.threads) {}

void RobustSum::estimateScale(const Residuals& residuals) {
  const auto median = static_cast<double>(medianMagnitude(residuals));
  scale_ = std::max(min_scale_, kMedianToDeviation * median);
}

double RobustSum::cost(const Residuals& residuals) {
  if (residuals.num_visible == 0) return std::numeric_limits<double>::infinity();
  if (scale_ == 0.0) estimateScale(residuals);
  const std::size_t n = residuals.value.size();
  Recycled<std::vector<double>> sums;
  sums->resize(numChunks(n));
  forEachChunk(n, threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    (*sums)[chunk] = kernels::active().robustCost(kind_, static_cast<float>(scale_),
                                                  residuals.value.data() + begin,
                                                  residuals.visible.data() + begin, end - begin);
  });
  double sum = 0.0;
  for (const double part : *sums) sum += part;
  cost_ = sum * static_cast<double>(n) / static_cast<double>(residuals.num_visible);
  return cost_;
}

int RobustSum::scoreCovariance(const Residuals& residuals,
                               const std::array<const float*, 6>& jacobian,
                               const std::vector<float>& u, const std::vector<float>& v,
                               const Camera& camera, Matrix6& covariance) const {
  covariance.setZero();
  if (residuals.num_visible == 0 || scale_ == 0.0) return 0;
  const std::size_t n = residuals.value.size();
  const kernels::BlockGrid grid = {
      static_cast<float>(kBlocksPerRow) / static_cast<float>(camera.width), kBlocksPerRow};
  const int rows = static_cast<int>(static_cast<float>(camera.height) * grid.per_pixel) + 1;
  Recycled<std::vector<kernels::BlockScore>> blocks;
  blocks->assign(static_cast<std::size_t>(rows * grid.columns), kernels::BlockScore{});
  kernels::active().accumulateScores(kind_, static_cast<float>(scale_), residuals.value.data(),
                                     residuals.visible.data(), jacobian.data(), u.data(), v.data(),
                                     n, grid, blocks->data());
  int count = 0;
  const double factor =
      static_cast<double>(n) / (static_cast<double>(residuals.num_visible) * scale_ * scale_);
  for (const kernels::BlockScore& here : *blocks) {
    if (here.score[6] == 0.0F) continue;
    ++count;
    const Vector6 score =
        factor * Eigen::Map<const Eigen::Matrix<float, 6, 1>>(here.score).cast<double>();
    covariance += score * score.transpose();
  }
  return count;
}

QuadraticModel RobustSum::linearize(const Residuals& residuals,
                                    const std::array<const float*, 6>& jacobian, int iteration) {
  if (residuals.num_visible == 0) {
    QuadraticModel nothing;
    nothing.cost = std::numeric_limits<double>::infinity();
    return nothing;
  }
  // At the first iteration cost() has just estimated it at this pose.
  if (iteration > 0 && iteration < scale_iterations_) {
    estimateScale(residuals);
    cost(residuals);
  }
  const std::size_t n = residuals.value.size();
  Recycled<std::vector<kernels::LeastSquaresSums>> parts;
  parts->resize(numChunks(n));
  forEachChunk(n, threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    const float* columns[6];
    for (std::size_t k = 0; k < 6; ++k) columns[k] = jacobian[k] + begin;
    kernels::active().accumulateLeastSquares(
        kind_, static_cast<float>(scale_), residuals.value.data() + begin,
        residuals.visible.data() + begin, columns, end - begin, (*parts)[chunk]);
  });
  QuadraticModel model =
      toModel(*parts, static_cast<double>(n) /
                          (static_cast<double>(residuals.num_visible) * scale_ * scale_));
  // The Hessian of the weights alone is larger than that of the cost and makes every step too
  // short. Residuals below the minimum scale are not Gaussian of that scale: their actual curvature
  // is used.
  model.hessian *= scale_ > min_scale_ ? gaussianCurvature(kind_) : curvatureShare(*parts, kind_);
  model.cost = cost_;
  return model;
}

}  // namespace mivo
