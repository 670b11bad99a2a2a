// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/robust_weight.h"

#include <cmath>

namespace mivo {
namespace {

RobustLoss huber(float u) {
  const float magnitude = std::abs(u);
  if (magnitude <= kHuber) return {0.5F * u * u, 1.0F, 1.0F};
  return {kHuber * (magnitude - 0.5F * kHuber), kHuber / magnitude, 0.0F};
}

RobustLoss tukey(float u) {
  constexpr float kLimit = kTukey * kTukey / 6.0F;
  const float ratio = u / kTukey;
  const float rest = 1.0F - ratio * ratio;
  if (rest <= 0.0F) return {kLimit, 0.0F, 0.0F};
  return {kLimit * (1.0F - rest * rest * rest), rest * rest, rest * (5.0F * rest - 4.0F)};
}

RobustLoss studentT(float u) {
  const float weight = (kFreedom + 1.0F) / (kFreedom + u * u);
  return {0.5F * (kFreedom + 1.0F) * std::log1p(u * u / kFreedom), weight,
          weight * (kFreedom - u * u) / (kFreedom + u * u)};
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
  return {0.5F * u * u, 1.0F, 1.0F};
}

double gaussianCurvature(RobustWeight kind) {
  // Integrals over the standard normal density.
  switch (kind) {
    case RobustWeight::kHuber:
      return 0.8557;
    case RobustWeight::kTukey:
      return 0.8281;
    case RobustWeight::kStudentT:
      return 0.7777;
    case RobustWeight::kNone:
      break;
  }
  return 1.0;
}

}  // namespace mivo
