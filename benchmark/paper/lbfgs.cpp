// SPDX-License-Identifier: BSD-3-Clause
#include "lbfgs.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <cmath>

#include "mivo/core/se3.h"

namespace mivo {
namespace {

// Of a central difference of a cost whose samples are single precision, in radians: a twentieth of
// a pixel on the finest level.
constexpr double kDifferenceStep = 1e-4;

/// Left Jacobian of SO(3): exp(w + dw) = exp(J dw) exp(w) to first order.
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d W = skew(w);
  if (angle < 1e-6) return Eigen::Matrix3d::Identity() + 0.5 * W;
  const double a2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / a2 * W +
         (angle - std::sin(angle)) / (a2 * angle) * W * W;
}

class PoseCost : public ceres::FirstOrderFunction {
 public:
  PoseCost(CostTerm& term, const Eigen::Isometry3d& T_live_ref, double length,
           GradientSource source)
      : term_(term), T_live_ref_(T_live_ref), length_(length), source_(source) {}

  int NumParameters() const override { return 6; }

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    const Vector6 p = Eigen::Map<const Vector6>(parameters);
    *cost = evaluate(p);
    if (!std::isfinite(*cost)) return false;
    if (gradient == nullptr) return true;
    ++gradients_;
    Eigen::Map<Vector6> g(gradient);
    g = source_ == GradientSource::kTerm ? gradientOfTerm(p) : gradientByDifferences(p);
    return g.allFinite();
  }

  Vector6 increment(const Vector6& p) const {
    Vector6 d = p;
    d.head<3>() *= length_;
    return d;
  }
  Eigen::Isometry3d pose(const Vector6& p) const {
    return orthonormalized(T_live_ref_ * retract(increment(p)).inverse());
  }
  int evaluations() const { return evaluations_; }
  int gradients() const { return gradients_; }

 private:
  double evaluate(const Vector6& p) const {
    ++evaluations_;
    return term_.evaluate(pose(p));
  }

  /// The term's gradient is with respect to an increment e at the pose reached, T retract(e)^-1.
  /// With retract(d + dd) = retract(e) retract(d): e_w = J dd_w and e_v = dd_v + v x e_w.
  Vector6 gradientOfTerm(const Vector6& p) const {
    const Vector6 d = increment(p);
    const Vector6 g = term_.linearize(0).gradient;
    Vector6 result;
    result.head<3>() = length_ * g.head<3>();
    const Eigen::Matrix3d J = leftJacobian(d.tail<3>());
    result.tail<3>() = J.transpose() * (g.tail<3>() + skew(d.head<3>()).transpose() * g.head<3>());
    return result;
  }

  Vector6 gradientByDifferences(const Vector6& p) const {
    Vector6 result;
    for (int k = 0; k < 6; ++k) {
      const Vector6 step = kDifferenceStep * Vector6::Unit(k);
      result[k] = (evaluate(p + step) - evaluate(p - step)) / (2.0 * kDifferenceStep);
    }
    return result;
  }

  CostTerm& term_;
  Eigen::Isometry3d T_live_ref_;
  double length_;
  GradientSource source_;
  mutable int evaluations_ = 0;
  mutable int gradients_ = 0;
};

}  // namespace

LbfgsResult minimizeByLbfgs(CostTerm& term, const Eigen::Isometry3d& T_live_ref, double length,
                            GradientSource source, const Parameters& parameters) {
  auto* function = new PoseCost(term, T_live_ref, length, source);
  const ceres::GradientProblem problem(function);  // owns the function
  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::LBFGS;
  options.function_tolerance = parameters.alignment.min_cost_change;
  options.logging_type = ceres::SILENT;
  Vector6 p = Vector6::Zero();
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, p.data(), &summary);
  LbfgsResult result;
  result.T_live_ref = function->pose(p);
  result.cost = summary.final_cost;
  result.iterations = static_cast<int>(summary.iterations.size());
  result.evaluations = function->evaluations();
  result.gradients = function->gradients();
  return result;
}

}  // namespace mivo
