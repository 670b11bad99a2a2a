// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/kernels/kernels.h"

namespace mivo {
namespace kernels {
namespace reference {

using Number = float;

inline Number constant(float value) {
  return value;
}
inline Number squareRoot(Number x) {
  return std::sqrt(x);
}
inline Number arcTangent(Number x) {
  return std::atan(x);
}
inline Number tangent(Number x) {
  return std::tan(x);
}

}  // namespace reference
}  // namespace kernels
}  // namespace mivo

#define MIVO_FORMULAS reference
#define MIVO_INLINE inline
#include "core/kernels/lens_formulas-inl.h"
//
#include "core/kernels/point_formulas-inl.h"
#undef MIVO_FORMULAS
#undef MIVO_INLINE
