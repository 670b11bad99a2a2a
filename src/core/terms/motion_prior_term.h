// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/terms/cost_term.h"

namespace mivo {

/// The camera is about where its motion so far leads: half the squared distance of a pose from the
/// expected one, over the covariance of that. Holds what the other terms leave open, where depth
/// alone sees a plane or a corridor, and where a coarse level sees next to nothing.
class MotionPriorTerm : public CostTerm {
 public:
  /// @param covariance of the expected pose's error, in the axes of the expected camera, m and rad
  /// @param weight how many times the other terms count what they know, since their residuals are
  /// not independent; the prior has to be counted as often.
  MotionPriorTerm(const Eigen::Isometry3d& T_live_ref_expected, const Matrix6& covariance,
                  double weight);

  double evaluate(const Eigen::Isometry3d& T_live_ref) override;
  QuadraticModel linearise(int iteration) override;

 private:
  Eigen::Isometry3d T_expected_ref_;
  Matrix6 information_;                                                // weighted
  Eigen::Isometry3d T_expected_live_ = Eigen::Isometry3d::Identity();  // of the last evaluate()
};

}  // namespace mivo
