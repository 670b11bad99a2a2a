// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/ssd_term.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mivo/core/parallel_chunks.h"
#include "mivo/core/robust_weight.h"

namespace mivo {
namespace {

// Standard deviation of a Gaussian in medians of its magnitude.
constexpr double kMedianToDeviation = 1.4826;

struct Sums {
  std::array<double, kSymmetric6> hessian{};
  std::array<double, 6> gradient{};
};

}  // namespace

SsdTerm::SsdTerm(const ReferencePoints& points, const cv::Mat& live_image, const Warp& warp,
                 const Parameters& parameters)
    : points_(points),
      live_image_(live_image),
      warp_(warp),
      weight_(parameters.robust_weight),
      scale_iterations_(parameters.robust_scale_iterations),
      min_scale_(parameters.min_residual_scale),
      threads_(parameters.threads) {}

double SsdTerm::evaluate(const Eigen::Isometry3d& T_live_ref) {
  warp_.sample(points_, T_live_ref, live_image_, samples_);
  if (samples_.num_visible == 0) return std::numeric_limits<double>::infinity();
  if (scale_ == 0.0) scale_ = estimateScale();
  return cost();
}

double SsdTerm::estimateScale() {
  magnitudes_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (samples_.visible[i] != 0) {
      magnitudes_.push_back(std::abs(samples_.intensity[i] - points_.intensity[i]));
    }
  }
  const auto middle = magnitudes_.begin() + static_cast<std::ptrdiff_t>(magnitudes_.size() / 2);
  std::nth_element(magnitudes_.begin(), middle, magnitudes_.end());
  return std::max(min_scale_, kMedianToDeviation * static_cast<double>(*middle));
}

double SsdTerm::cost() const {
  std::vector<double> sums(numChunks(points_.size()));
  const auto inverse_scale = static_cast<float>(1.0 / scale_);
  forEachChunk(points_.size(), threads_,
               [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                 double sum = 0.0;
                 for (std::size_t i = begin; i < end; ++i) {
                   if (samples_.visible[i] == 0) continue;
                   const float residual = samples_.intensity[i] - points_.intensity[i];
                   sum += static_cast<double>(robustLoss(weight_, residual * inverse_scale).loss);
                 }
                 sums[chunk] = sum;
               });
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum * static_cast<double>(points_.size()) / static_cast<double>(samples_.num_visible);
}

QuadraticModel SsdTerm::linearise(int iteration) {
  if (samples_.num_visible == 0) return {std::numeric_limits<double>::infinity(), {}, {}};
  // The first evaluate() has just estimated it at this pose.
  if (iteration > 0 && iteration < scale_iterations_) scale_ = estimateScale();
  std::vector<Sums> parts(numChunks(points_.size()));
  const auto inverse_scale = static_cast<float>(1.0 / scale_);
  forEachChunk(points_.size(), threads_,
               [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                 Sums& part = parts[chunk];
                 for (std::size_t i = begin; i < end; ++i) {
                   if (samples_.visible[i] == 0) continue;
                   const float residual = samples_.intensity[i] - points_.intensity[i];
                   const float weight = robustLoss(weight_, residual * inverse_scale).weight;
                   std::array<float, 6> J;
                   for (std::size_t k = 0; k < 6; ++k) J[k] = points_.jacobian[k][i];
                   std::size_t entry = 0;
                   for (std::size_t row = 0; row < 6; ++row) {
                     const float weighted = weight * J[row];
                     part.gradient[row] += static_cast<double>(weighted * residual);
                     for (std::size_t column = row; column < 6; ++column) {
                       part.hessian[entry++] += static_cast<double>(weighted * J[column]);
                     }
                   }
                 }
               });
  Sums total;
  for (const Sums& part : parts) {
    for (std::size_t k = 0; k < 6; ++k) total.gradient[k] += part.gradient[k];
    for (std::size_t k = 0; k < kSymmetric6; ++k) total.hessian[k] += part.hessian[k];
  }
  // Residual of the warped keyframe: r(d) = r - J d, hence the minus sign.
  const double factor = static_cast<double>(points_.size()) /
                        (static_cast<double>(samples_.num_visible) * scale_ * scale_);
  QuadraticModel model;
  model.cost = cost();
  std::size_t entry = 0;
  for (int row = 0; row < 6; ++row) {
    model.gradient[row] = -factor * total.gradient[static_cast<std::size_t>(row)];
    for (int column = row; column < 6; ++column) {
      model.hessian(row, column) = model.hessian(column, row) = factor * total.hessian[entry++];
    }
  }
  return model;
}

}  // namespace mivo
