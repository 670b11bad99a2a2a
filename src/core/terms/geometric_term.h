// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "core/execution/recycled.h"
#include "core/geometry/warp.h"
#include "core/images/frame_pyramid.h"
#include "core/keyframe/geometric_points.h"
#include "core/terms/cost_term.h"
#include "core/terms/robust_sum.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Projective point to plane: the live depth Y where a keyframe point X falls should lie in the
/// plane of X, r = n . (T_ref_live Y - X). Residuals are in standard deviations of a depth reading,
/// so that the cost is in nats like that of the photometric terms; their scale is estimated and at
/// least one.
class GeometricTerm : public CostTerm {
 public:
  /// Keeps references to points, live frame and warp. @param warp that of level 0. @param
  /// num_points number of points to use, in their order.
  GeometricTerm(const GeometricPoints& points, std::size_t num_points, const FramePyramid& live,
                const Warp& warp, const Parameters& parameters);

  double evaluate(const Eigen::Isometry3d& T_live_ref) override;
  QuadraticModel linearize(int iteration) override;
  int gradientCovariance(Matrix6& covariance) const override;
  Agreement agreement(std::size_t most_points) const override;

  std::size_t numVisible() const { return residuals_->num_visible; }

  /// Factor by which the costs are too certain: with independent residuals the covariance of the
  /// gradient would be the Hessian. At least 1.
  double overconfidence();

  /// Scale of the residuals in deviations of a reading, at least 1.
  double scale() const { return sum_.scale(); }

 private:
  void measure(const Eigen::Isometry3d& T_live_ref);

  const GeometricPoints& points_;
  std::size_t num_points_;
  const FramePyramid& live_;
  const Warp& warp_;
  RobustSum sum_;
  Eigen::Isometry3d T_live_ref_;  // of the residuals
  bool is_measured_ = false;
  Recycled<std::vector<float>> u_, v_;
  Recycled<Residuals> residuals_;
  Recycled<std::array<std::vector<float>, 6>> jacobian_;
};

}  // namespace mivo
