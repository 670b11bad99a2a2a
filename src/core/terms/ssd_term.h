// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/execution/recycled.h"
#include "core/geometry/warp.h"
#include "core/images/contrast_maps.h"
#include "core/keyframe/reference_points.h"
#include "core/terms/cost_term.h"
#include "core/terms/robust_sum.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Robust sum of squared differences (Eq. 1), inverse compositional Gauss-Newton: residual
/// r = contrast * live - intensity, in gray levels, with a scale estimated from the residuals. If
/// negative_images is set and the normalized images are negatively correlated at the first pose,
/// the live image is inverted.
class SsdTerm : public CostTerm {
 public:
  /// Of the first `num_points` points. Keeps references to all arguments but the parameters.
  /// @param contrast of the live image; null: intensities are compared as they are.
  SsdTerm(const ReferencePoints& points, std::size_t num_points, const cv::Mat& live_image,
          const ContrastMap* contrast, const Warp& warp, const Parameters& parameters);

  double evaluate(const Eigen::Isometry3d& T_live_ref) override;
  QuadraticModel linearize(int iteration) override;
  int gradientCovariance(Matrix6& covariance) const override;
  Agreement agreement(std::size_t most_points) const override;

  /// Robust standard deviation of the residuals, gray levels; 0 before the first evaluate().
  double scale() const { return sum_.scale(); }

  /// Correlation of what keyframe and live image show at the last pose, -1..1.
  double correlation() const;

  /// Whether that correlation is significant.
  bool isSignificant() const;

  /// Whether it was significant in the first iterations of the level. If not, the term has
  /// practically no weight.
  bool isInformative() const { return weight_ == 1.0; }

  std::size_t numVisible() const { return residuals_->num_visible; }
  std::size_t numInView() const { return samples_->num_in_view; }  ///< saturated ones too
  const Residuals& residuals() const { return *residuals_; }
  /// Projected points and sampled values; `visible` is stored with the residuals.
  const LiveSamples& samples() const { return *samples_; }

 private:
  void sample(const Eigen::Isometry3d& T_live_ref);

  const ReferencePoints& points_;
  std::size_t num_points_;
  const cv::Mat& live_image_;
  const ContrastMap* contrast_;
  const Warp& warp_;
  RobustSum sum_;
  double saturation_;
  bool may_be_negative_;
  double least_correlation_;  // a stronger negative correlation is significant
  bool is_inverted_ = false;
  int scale_iterations_;
  double weight_ = 1.0;
  Eigen::Isometry3d T_live_ref_;  // of the samples
  bool is_sampled_ = false;
  Recycled<LiveSamples> samples_;
  Recycled<Residuals> residuals_;
};

}  // namespace mivo
