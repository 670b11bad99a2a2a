// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>

#include "core/terms/agreement.h"
#include "mivo/core/se3.h"

namespace mivo {

/// A cost around a pose as a function of the increment d that warps the keyframe:
/// cost + gradient . d + dᵀ hessian d / 2. In nats, so that terms add up, and to be minimised.
struct QuadraticModel {
  double cost = 0.0;
  Vector6 gradient = Vector6::Zero();
  Matrix6 hessian = Matrix6::Zero();
};

/// Fewer blocks of the image say nothing about how much they err together.
constexpr int kFewestBlocks = 15;
/// As iteration of linearise(): the scale of the residuals stays what it is.
constexpr int kScaleIsKept = 1 << 20;

/// One way of saying how well a pose aligns the live frame with the keyframe, on one level.
class CostTerm {
 public:
  virtual ~CostTerm() = default;

  /// Cost at a pose, in nats: the mean over the points in view times the number of all points, so
  /// that points that leave the view make it neither better nor worse. Infinite without any.
  virtual double evaluate(const Eigen::Isometry3d& T_live_ref) = 0;

  /// Model around the pose of the last evaluate(). `iteration` counts from 0 on a level. A term may
  /// first adapt its scale to what it sees; later costs are comparable with the cost returned here.
  virtual QuadraticModel linearise(int iteration) = 0;

  /// Covariance of the gradient at the pose of the last evaluate(), from how blocks of the image
  /// disagree (see RobustSum::scoreCovariance), and how many blocks there are. 0: not known, the
  /// Hessian has to stand for it.
  virtual int gradientCovariance(Matrix6& covariance) const {
    covariance.setZero();
    return 0;
  }

  /// How the derivatives of keyframe and live frame agree at the pose of the last evaluate().
  /// @param most_points how many to compare at most: fewer are quicker, more tell less from chance
  virtual Agreement agreement(std::size_t /*most_points*/) const { return {}; }
};

}  // namespace mivo
