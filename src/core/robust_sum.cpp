// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/robust_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mivo/core/kernels/kernels.h"
#include "mivo/core/parallel_chunks.h"

namespace mivo {
namespace {

// Standard deviation of a Gaussian in medians of its magnitude.
constexpr double kMedianToDeviation = 1.4826;

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

}  // namespace

RobustSum::RobustSum(RobustWeight kind, double min_scale, const Parameters& parameters)
    : kind_(kind),
      min_scale_(min_scale),
      scale_iterations_(parameters.robust_scale_iterations),
      threads_(parameters.threads) {}

void RobustSum::estimateScale(const Residuals& residuals) {
  magnitudes_.clear();
  for (std::size_t i = 0; i < residuals.value.size(); ++i) {
    if (residuals.visible[i] != 0.0F) magnitudes_.push_back(std::abs(residuals.value[i]));
  }
  const auto middle = magnitudes_.begin() + static_cast<std::ptrdiff_t>(magnitudes_.size() / 2);
  std::nth_element(magnitudes_.begin(), middle, magnitudes_.end());
  scale_ = std::max(min_scale_, kMedianToDeviation * static_cast<double>(*middle));
}

double RobustSum::cost(const Residuals& residuals) {
  if (residuals.num_visible == 0) return std::numeric_limits<double>::infinity();
  if (scale_ == 0.0) estimateScale(residuals);
  const std::size_t n = residuals.value.size();
  std::vector<double> sums(numChunks(n));
  forEachChunk(n, threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    sums[chunk] =
        kernels::robustCost(kind_, static_cast<float>(scale_), residuals.value.data() + begin,
                            residuals.visible.data() + begin, end - begin);
  });
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum * static_cast<double>(n) / static_cast<double>(residuals.num_visible);
}

QuadraticModel RobustSum::linearise(const Residuals& residuals,
                                    const std::array<const float*, 6>& jacobian, int iteration) {
  if (residuals.num_visible == 0) {
    QuadraticModel nothing;
    nothing.cost = std::numeric_limits<double>::infinity();
    return nothing;
  }
  // At the first iteration cost() has just estimated it at this pose.
  if (iteration > 0 && iteration < scale_iterations_) estimateScale(residuals);
  const std::size_t n = residuals.value.size();
  std::vector<kernels::LeastSquaresSums> parts(numChunks(n));
  forEachChunk(n, threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    const float* columns[6];
    for (std::size_t k = 0; k < 6; ++k) columns[k] = jacobian[k] + begin;
    kernels::accumulateLeastSquares(
        kind_, static_cast<float>(scale_), residuals.value.data() + begin,
        residuals.visible.data() + begin, columns, end - begin, parts[chunk]);
  });
  QuadraticModel model =
      toModel(parts, static_cast<double>(n) /
                         (static_cast<double>(residuals.num_visible) * scale_ * scale_));
  model.cost = cost(residuals);
  return model;
}

}  // namespace mivo
