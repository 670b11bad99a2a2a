// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/parameters.h"

namespace mivo {

/// Loss rho(u) of a residual u in units of its scale, convex near zero, and its weight
/// rho'(u) / u. Shapes and constants stand at the parameter robust_weight.
struct RobustLoss {
  float loss;
  float weight;
};
RobustLoss robustLoss(RobustWeight kind, float u);

}  // namespace mivo
