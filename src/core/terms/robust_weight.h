// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/parameter_choices.h"

namespace mivo {

// 95 % efficiency for Gaussian residuals (Huber; Beaton and Tukey).
constexpr float kHuber = 1.345F;
constexpr float kTukey = 4.685F;
// Degrees of freedom of Student's t.
constexpr float kFreedom = 5.0F;

/// Loss rho(u) of a residual u in units of its scale, weight rho'(u) / u, and curvature rho''(u),
/// which is negative for outliers. Formulas: parameter robust_weight.
struct RobustLoss {
  float loss;
  float weight;
  float curvature;
};
RobustLoss robustLoss(RobustWeight kind, float u);

/// Ratio of mean curvature to mean weight for Gaussian residuals; 1 without robust weights.
double gaussianCurvature(RobustWeight kind);

}  // namespace mivo
