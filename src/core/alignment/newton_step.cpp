// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/newton_step.h"

#include <algorithm>

#include "core/symmetric.h"

namespace mivo {

NewtonStep newtonStep(const QuadraticModel& model, double length, double min_curvature) {
  NewtonStep result;
  if (!model.gradient.allFinite() || !model.hessian.allFinite()) return result;
  Vector6 scale = Vector6::Ones();
  scale.head<3>().setConstant(length);
  const Matrix6 scaled = scale.asDiagonal() * model.hessian * scale.asDiagonal();
  const auto solver = symmetricEigen(scaled);
  const Vector6 curvature = solver.eigenvalues();
  const double strongest = curvature.cwiseAbs().maxCoeff();
  if (!(strongest > 0.0)) return result;
  const double bound = min_curvature * strongest;
  const Vector6 guarded = curvature.cwiseAbs().cwiseMax(bound);
  const Matrix6& axes = solver.eigenvectors();
  const Vector6 gradient = scale.asDiagonal() * model.gradient;
  const Vector6 step = -(axes * guarded.cwiseInverse().asDiagonal() * axes.transpose() * gradient);
  result.step = scale.asDiagonal() * step;
  result.promised_gain = -model.gradient.dot(result.step);
  const Vector6 inverse = scale.cwiseInverse();
  result.guarded_hessian = inverse.asDiagonal() * (axes * guarded.asDiagonal() * axes.transpose()) *
                           inverse.asDiagonal();
  result.is_convex = curvature.minCoeff() >= bound;
  return result;
}

}  // namespace mivo
