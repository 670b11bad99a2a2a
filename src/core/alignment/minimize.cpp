// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/minimize.h"

#include <algorithm>
#include <cmath>

#include "core/alignment/newton_step.h"
#include "core/execution/cpu_clock.h"

namespace mivo {
namespace {

double evaluate(const std::vector<CostTerm*>& terms, const Eigen::Isometry3d& T_live_ref) {
  double cost = 0.0;
  for (CostTerm* term : terms) cost += term->evaluate(T_live_ref);
  return cost;
}

QuadraticModel linearize(const std::vector<CostTerm*>& terms, int iteration) {
  QuadraticModel sum;
  for (CostTerm* term : terms) {
    const QuadraticModel model = term->linearize(iteration);
    sum.cost += model.cost;
    sum.gradient += model.gradient;
    sum.hessian += model.hessian;
  }
  return sum;
}

/// Inverse composition (Eq. 5).
Eigen::Isometry3d moved(const Eigen::Isometry3d& T_live_ref, const Vector6& step) {
  return orthonormalized(T_live_ref * retract(step).inverse());
}

/// Projects a step onto the free directions.
void hold(const QuadraticModel& model, const Matrix6& free, NewtonStep& newton) {
  newton.step = free * newton.step;
  const double gain = -model.gradient.dot(newton.step);
  newton.promised_gain = gain < 0.0 ? 0.0 : gain;  // what is not a number stays so
}

}  // namespace

Minimum minimize(const std::vector<CostTerm*>& terms, const Eigen::Isometry3d& T_live_ref,
                 double length, const Matrix6& pixel_motion, const Parameters& parameters,
                 double tolerance, double trusted_step_pixels, const Matrix6* free) {
  const double min_step_pixels = tolerance * parameters.alignment.min_step_pixels;
  Minimum minimum;
  minimum.T_live_ref = T_live_ref;
  minimum.cost = evaluate(terms, T_live_ref);
  minimum.evaluations = 1;
  bool is_evaluated_there = true;  // the terms were last evaluated at minimum.T_live_ref
  while (std::isfinite(minimum.cost) && minimum.iterations < parameters.alignment.max_iterations) {
    const QuadraticModel model = linearize(terms, minimum.iterations);
    minimum.cost = model.cost;
    NewtonStep newton = newtonStep(model, length, parameters.alignment.min_curvature);
    if (free != nullptr) hold(model, *free, newton);
    minimum.hessian = model.hessian;
    // Half the slope is the gain of a quadratic cost. Without this test the last iteration would
    // use all its halvings in vain.
    const double enough = tolerance * parameters.alignment.min_cost_change * std::abs(model.cost);
    const double squared_pixels = newton.step.dot(pixel_motion * newton.step);
    // Tested before max(), which would turn NaN into zero.
    if (!std::isfinite(squared_pixels) || !std::isfinite(newton.promised_gain)) break;
    const double pixels = std::sqrt(std::max(0.0, squared_pixels));
    if (0.5 * newton.promised_gain <= enough || !(pixels > 0.0)) break;

    if (newton.is_convex && pixels < trusted_step_pixels) {
      // So near to the minimum the quadratic model is accurate: the step is accepted without a line
      // search.
      minimum.T_live_ref = moved(minimum.T_live_ref, newton.step);
      minimum.cost = model.cost - 0.5 * newton.promised_gain;
      ++minimum.iterations;
      break;
    }

    double length_factor = std::min(1.0, parameters.alignment.max_step_pixels / pixels);
    bool is_accepted = false;
    const double start = threadMilliseconds();
    for (int halving = 0; halving <= parameters.alignment.line_search_halvings; ++halving) {
      const Eigen::Isometry3d candidate = moved(minimum.T_live_ref, length_factor * newton.step);
      const double cost = evaluate(terms, candidate);
      ++minimum.evaluations;
      is_evaluated_there = false;
      if (cost <= model.cost - parameters.alignment.line_search_slope * length_factor *
                                   newton.promised_gain) {
        minimum.T_live_ref = candidate;
        minimum.cost = cost;
        is_accepted = true;
        is_evaluated_there = true;
        break;
      }
      length_factor *= 0.5;
      // The remaining step can neither gain enough to continue nor move the points noticeably.
      if (length_factor * newton.promised_gain <= enough ||
          length_factor * pixels < min_step_pixels) {
        break;
      }
    }
    minimum.line_search_milliseconds += threadMilliseconds() - start;
    if (!is_accepted) break;
    ++minimum.iterations;
    if (length_factor * pixels < min_step_pixels || model.cost - minimum.cost < enough) break;
  }
  if (!is_evaluated_there) minimum.cost = evaluate(terms, minimum.T_live_ref);
  return minimum;
}

}  // namespace mivo
