// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/terms/cost_term.h"

namespace mivo {

/// How far a pose may be from the predicted one, standard deviations.
struct MotionUncertainty {
  double translation = 0.0;  ///< m
  double rotation = 0.0;     ///< rad
};

/// The camera keeps its velocity: half the squared distance of a pose from the predicted one, in
/// the live camera's axes. Holds what the other terms leave open, where depth alone sees a plane or
/// a corridor.
class MotionPriorTerm : public CostTerm {
 public:
  /// @param weight how many times the other terms count what they know, since their residuals are
  /// not independent; the prior has to be counted as often.
  MotionPriorTerm(const Eigen::Isometry3d& T_live_ref_predicted,
                  const MotionUncertainty& uncertainty, double weight);

  double evaluate(const Eigen::Isometry3d& T_live_ref) override;
  QuadraticModel linearise(int iteration) override;

  /// Known exactly: the gradient would err as much as the prediction does.
  int gradientCovariance(Matrix6& covariance) const override;

 private:
  Vector6 information() const;

  Eigen::Isometry3d T_predicted_ref_;
  MotionUncertainty uncertainty_;
  double weight_;
  Eigen::Isometry3d T_predicted_live_ = Eigen::Isometry3d::Identity();  // of the last evaluate()
};

}  // namespace mivo
