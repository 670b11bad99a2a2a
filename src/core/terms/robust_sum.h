// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "core/terms/cost_term.h"
#include "mivo/core/camera.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Residuals of one term at one pose, one entry per point.
struct Residuals {
  std::vector<float> value;    ///< 0 where not visible
  std::vector<float> visible;  ///< 1 or 0
  std::size_t num_visible = 0;
};

/// Robust least squares of SSD and depth term: cost and normal equations of residuals. Their scale
/// is 1.4826 times the median of their magnitude.
class RobustSum {
 public:
  /// @param min_scale lower bound of the scale, in units of the residuals
  RobustSum(RobustWeight kind, double min_scale, const Parameters& parameters);

  /// Mean loss of the visible points times the number of all, nats; infinite without any. The first
  /// call estimates the scale.
  double cost(const Residuals& residuals);

  /// Model for residuals r(d) = r - J d, those of the last cost(). The scale is estimated again in
  /// the first iterations of a level.
  QuadraticModel linearize(const Residuals& residuals, const std::array<const float*, 6>& jacobian,
                           int iteration);

  /// Covariance of the gradient that linearize() gives, estimated from blocks of the image:
  /// neighboring points have common errors (depth, blur) and count as one. In the units of the
  /// Hessian; by H⁻¹ C H⁻¹ it becomes that of the increment. @param u, @param v pixels of the
  /// points, in the image of `camera`. Returns the number of blocks with points.
  int scoreCovariance(const Residuals& residuals, const std::array<const float*, 6>& jacobian,
                      const std::vector<float>& u, const std::vector<float>& v,
                      const Camera& camera, Matrix6& covariance) const;

  double scale() const { return scale_; }  ///< 0 before the first cost()

 private:
  void estimateScale(const Residuals& residuals);

  RobustWeight kind_;
  double min_scale_;
  int scale_iterations_;
  int threads_;
  double scale_ = 0.0;
  double cost_ = 0.0;  // the last one
};

}  // namespace mivo
