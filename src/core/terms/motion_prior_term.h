// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/terms/cost_term.h"

namespace mivo {

/// Prior at the predicted pose: half the squared Mahalanobis distance. It constrains directions
/// that the other terms leave open, where depth alone shows a plane or a corridor, and coarse
/// levels with little information.
class MotionPriorTerm : public CostTerm {
 public:
  /// @param covariance of the expected pose's error, in the axes of the expected camera, m and rad
  /// @param weight factor by which the other terms are overconfident because of correlated
  /// residuals; the prior is multiplied by it.
  MotionPriorTerm(const Eigen::Isometry3d& T_live_ref_expected, const Matrix6& covariance,
                  double weight);

  double evaluate(const Eigen::Isometry3d& T_live_ref) override;
  QuadraticModel linearize(int iteration) override;

 private:
  Eigen::Isometry3d T_expected_ref_;
  Matrix6 information_;                                                // weighted
  Eigen::Isometry3d T_expected_live_ = Eigen::Isometry3d::Identity();  // of the last evaluate()
};

}  // namespace mivo
