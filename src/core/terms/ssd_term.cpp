// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/ssd_term.h"

#include <cmath>
#include <utility>

#include "core/terms/image_agreement.h"

namespace mivo {
namespace {

// correlation * sqrt(n) > this: the correlation of n independent pairs has a standard deviation of
// 1 / sqrt(n).
constexpr double kSignificance = 4.0;
// Small enough to have no influence beside another term.
constexpr double kNoWeight = 1e-6;

}  // namespace

SsdTerm::SsdTerm(const ReferencePoints& points, std::size_t num_points, const cv::Mat& live_image,
                 const ContrastMap* contrast, const Warp& warp, const Parameters& parameters)
    : points_(points),
      num_points_(num_points),
      live_image_(live_image),
      contrast_(contrast),
      warp_(warp),
      sum_(parameters.ssd.robust_weight, parameters.ssd.min_residual_scale, parameters),
      saturation_(parameters.alignment.saturation),
      may_be_negative_(parameters.ssd.negative_images && contrast != nullptr),
      least_correlation_(parameters.loss.retry_correlation),
      scale_iterations_(parameters.ssd.robust_scale_iterations) {}

double SsdTerm::evaluate(const Eigen::Isometry3d& T_live_ref) {
  if (!is_sampled_ || T_live_ref.matrix() != T_live_ref_.matrix()) sample(T_live_ref);
  return weight_ * sum_.cost(*residuals_);
}

void SsdTerm::sample(const Eigen::Isometry3d& T_live_ref) {
  if (contrast_ != nullptr) {
    warp_.sampleNormalized(points_, num_points_, T_live_ref, live_image_, *contrast_, saturation_,
                           *samples_);
  } else {
    warp_.sample(points_, num_points_, T_live_ref, live_image_, *samples_);
  }
  residuals_->value.resize(num_points_);
  std::swap(residuals_->visible, samples_->visible);
  residuals_->num_visible = samples_->num_visible;
  if (may_be_negative_ && !is_sampled_) is_inverted_ = correlation() < -least_correlation_;
  if (is_inverted_) {
    for (float& value : samples_->value) value = -value;
  }
  kernels::active().residuals(samples_->value.data(), points_.contrast.data(),
                              points_.intensity.data(), residuals_->visible.data(), num_points_,
                              residuals_->value.data());
  T_live_ref_ = T_live_ref;
  is_sampled_ = true;
}

QuadraticModel SsdTerm::linearize(int iteration) {
  std::array<const float*, 6> jacobian;
  for (std::size_t k = 0; k < 6; ++k) jacobian[k] = points_.jacobian[k].data();
  if (iteration < scale_iterations_) weight_ = isSignificant() ? 1.0 : kNoWeight;
  QuadraticModel model = sum_.linearize(*residuals_, jacobian, iteration);
  model.cost *= weight_;
  model.gradient *= weight_;
  model.hessian *= weight_;
  return model;
}

int SsdTerm::gradientCovariance(Matrix6& covariance) const {
  std::array<const float*, 6> jacobian;
  for (std::size_t k = 0; k < 6; ++k) jacobian[k] = points_.jacobian[k].data();
  const int blocks = sum_.scoreCovariance(*residuals_, jacobian, samples_->u, samples_->v,
                                          warp_.camera(), covariance);
  covariance *= weight_ * weight_;
  return blocks;
}

Agreement SsdTerm::agreement(std::size_t most_points) const {
  return imageAgreement(points_, {live_image_, contrast_}, *samples_, residuals_->visible, warp_,
                        T_live_ref_, most_points);
}

bool SsdTerm::isSignificant() const {
  return correlation() * std::sqrt(static_cast<double>(residuals_->num_visible)) > kSignificance;
}

double SsdTerm::correlation() const {
  kernels::PairSums sums{};
  kernels::active().sumPairs(samples_->value.data(), points_.intensity.data(),
                             points_.contrast.data(), residuals_->visible.data(), num_points_,
                             sums);
  const auto n = static_cast<double>(residuals_->num_visible);
  const double spread = (n * sums.aa - sums.a * sums.a) * (n * sums.bb - sums.b * sums.b);
  return spread > 0.0 ? (n * sums.ab - sums.a * sums.b) / std::sqrt(spread) : 0.0;
}

}  // namespace mivo
