// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>

#include "core/terms/agreement.h"
#include "mivo/core/se3.h"

namespace mivo {

/// A cost around a pose as a function of the increment d that warps the keyframe:
/// cost + gradient . d + dᵀ hessian d / 2. In nats, so that terms add up, and to be minimized.
struct QuadraticModel {
  double cost = 0.0;
  Vector6 gradient = Vector6::Zero();
  Matrix6 hessian = Matrix6::Zero();
};

/// Minimum number of image blocks for an estimate of their correlated errors.
constexpr int kFewestBlocks = 15;
/// As iteration of linearize(): keep the scale of the residuals.
constexpr int kScaleIsKept = 1 << 20;

/// A cost of aligning the live frame with the keyframe at a pose, on one level.
class CostTerm {
 public:
  virtual ~CostTerm() = default;

  /// Cost at a pose, in nats: the mean over the points in view times the number of all points, so
  /// that points leaving the view do not change it. Infinite if none is in view.
  virtual double evaluate(const Eigen::Isometry3d& T_live_ref) = 0;

  /// Model around the pose of the last evaluate(). `iteration` counts from 0 on a level. A term may
  /// first update its scale; later costs are comparable with the cost returned here.
  virtual QuadraticModel linearize(int iteration) = 0;

  /// Covariance of the gradient at the pose of the last evaluate(), estimated from blocks of the
  /// image (see RobustSum::scoreCovariance). Returns the number of blocks; 0: not known, use the
  /// Hessian.
  virtual int gradientCovariance(Matrix6& covariance) const {
    covariance.setZero();
    return 0;
  }

  /// Agreement of the derivatives of keyframe and live frame at the pose of the last evaluate().
  /// @param most_points maximum number of points: fewer are faster, more are more significant
  virtual Agreement agreement(std::size_t /*most_points*/) const { return {}; }
};

}  // namespace mivo
