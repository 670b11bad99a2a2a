// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/parameters.h"

namespace mivo {

// 95 % efficiency for Gaussian residuals (Huber; Beaton and Tukey).
constexpr float kHuber = 1.345F;
constexpr float kTukey = 4.685F;
// Degrees of freedom of Student's t.
constexpr float kFreedom = 5.0F;

/// Loss rho(u) of a residual u in units of its scale, convex near zero, and its weight
/// rho'(u) / u. Shapes and constants stand at the parameter robust_weight.
struct RobustLoss {
  float loss;
  float weight;
};
RobustLoss robustLoss(RobustWeight kind, float u);

}  // namespace mivo
