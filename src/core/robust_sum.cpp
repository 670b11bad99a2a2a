// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/robust_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "mivo/core/kernels/kernels.h"
#include "mivo/core/parallel_chunks.h"
#include "mivo/core/recycled.h"
#include "mivo/core/robust_weight.h"

namespace mivo {
namespace {

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

// So many residuals tell the scale to two hundredths; of more, only every second, third, ... is
// asked.
constexpr std::size_t kEnoughForScale = 4096;

/// Median of the magnitudes of the visible residuals, 0 when there is none among those asked.
float medianMagnitude(const Residuals& residuals) {
  std::array<std::uint32_t, kSteps> counts{};
  const std::size_t n = residuals.value.size();
  const std::size_t stride = std::max<std::size_t>(1, n / kEnoughForScale);
  // Whether a point is visible is added, not asked: no branch can foresee it.
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
  Recycled<std::vector<float>> candidates;
  candidates->clear();
  for (std::size_t i = 0; i < n; i += stride) {
    if (residuals.visible[i] != 0.0F && stepOf(residuals.value[i]) == step) {
      candidates->push_back(std::abs(residuals.value[i]));
    }
  }
  const auto middle = candidates->begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(candidates->begin(), middle, candidates->end());
  return *middle;
}

/// Largest of numbers that are not negative, 0 of none. Eight at a time: one after the other each
/// comparison would wait for the last.
float largest(const std::vector<float>& values) {
  constexpr std::size_t kTogether = 8;
  std::array<float, kTogether> maxima{};
  std::size_t i = 0;
  for (; i + kTogether <= values.size(); i += kTogether) {
    for (std::size_t k = 0; k < kTogether; ++k) maxima[k] = std::max(maxima[k], values[i + k]);
  }
  float result = *std::max_element(maxima.begin(), maxima.end());
  for (; i < values.size(); ++i) result = std::max(result, values[i]);
  return result;
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

}  // namespace

RobustSum::RobustSum(RobustWeight kind, double min_scale, const Parameters& parameters)
    : kind_(kind),
      min_scale_(min_scale),
      scale_iterations_(parameters.robust_scale_iterations),
      threads_(parameters.threads) {}

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
  return sum * static_cast<double>(n) / static_cast<double>(residuals.num_visible);
}

int RobustSum::scoreCovariance(const Residuals& residuals,
                               const std::array<const float*, 6>& jacobian,
                               const std::vector<float>& u, const std::vector<float>& v,
                               double block, Matrix6& covariance) const {
  struct Block {
    Vector6 score = Vector6::Zero();
    int points = 0;
  };
  covariance.setZero();
  if (residuals.num_visible == 0 || scale_ == 0.0) return 0;
  const std::size_t n = residuals.value.size();
  const auto per_pixel = static_cast<float>(1.0 / block);
  const auto blockOf = [=](float pixel) { return static_cast<std::size_t>(pixel * per_pixel); };
  const std::size_t columns = blockOf(largest(u)) + 1;
  Recycled<std::vector<Block>> blocks;
  blocks->assign(columns * (blockOf(largest(v)) + 1), Block{});
  const auto inverse_scale = static_cast<float>(1.0 / scale_);
  for (std::size_t i = 0; i < n; ++i) {
    if (residuals.visible[i] == 0.0F) continue;
    Block& here = (*blocks)[blockOf(v[i]) * columns + blockOf(u[i])];
    const float scaled = residuals.value[i] * inverse_scale;
    const float influence = robustLoss(kind_, scaled).weight * scaled * inverse_scale;
    for (std::size_t k = 0; k < 6; ++k) {
      here.score[static_cast<int>(k)] += static_cast<double>(influence * jacobian[k][i]);
    }
    ++here.points;
  }
  int count = 0;
  const double factor = static_cast<double>(n) / static_cast<double>(residuals.num_visible);
  for (const Block& here : *blocks) {
    if (here.points == 0) continue;
    ++count;
    covariance += factor * factor * here.score * here.score.transpose();
  }
  return count;
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
  model.cost = cost(residuals);
  return model;
}

}  // namespace mivo
