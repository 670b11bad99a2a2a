// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/robust_weight.h"

#include <cmath>

namespace mivo {
namespace {

RobustLoss huber(float u) {
  const float magnitude = std::abs(u);
  if (magnitude <= kHuber) return {0.5F * u * u, 1.0F};
  return {kHuber * (magnitude - 0.5F * kHuber), kHuber / magnitude};
}

RobustLoss tukey(float u) {
  constexpr float kLimit = kTukey * kTukey / 6.0F;
  const float ratio = u / kTukey;
  const float rest = 1.0F - ratio * ratio;
  if (rest <= 0.0F) return {kLimit, 0.0F};
  return {kLimit * (1.0F - rest * rest * rest), rest * rest};
}

RobustLoss studentT(float u) {
  return {0.5F * (kFreedom + 1.0F) * std::log1p(u * u / kFreedom),
          (kFreedom + 1.0F) / (kFreedom + u * u)};
}

}  // namespace

RobustLoss robustLoss(RobustWeight kind, float u) {
  switch (kind) {
    case RobustWeight::kHuber:
      return huber(u);
    case RobustWeight::kTukey:
      return tukey(u);
    case RobustWeight::kStudentT:
      return studentT(u);
    case RobustWeight::kNone:
      break;
  }
  return {0.5F * u * u, 1.0F};
}

}  // namespace mivo
