// SPDX-License-Identifier: BSD-3-Clause
// The formulas of lenses and points with vectors, included by vector.cpp once for each instruction
// set.

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {

/// A vector that the shared formulas can be written with.
struct Number {
  FloatVector v;
};

HWY_INLINE Number operator+(Number a, Number b) {
  return {hn::Add(a.v, b.v)};
}
HWY_INLINE Number operator-(Number a, Number b) {
  return {hn::Sub(a.v, b.v)};
}
HWY_INLINE Number operator*(Number a, Number b) {
  return {hn::Mul(a.v, b.v)};
}
HWY_INLINE Number operator/(Number a, Number b) {
  return {hn::Div(a.v, b.v)};
}
HWY_INLINE Number constant(float value) {
  return {all(value)};
}
HWY_INLINE Number squareRoot(Number x) {
  return {hn::Sqrt(x.v)};
}
HWY_INLINE Number arcTangent(Number x) {
  return {hn::Atan(Floats(), x.v)};
}
HWY_INLINE Number tangent(Number x) {
  return {hn::Div(hn::Sin(Floats(), x.v), hn::Cos(Floats(), x.v))};
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo

#define MIVO_FORMULAS HWY_NAMESPACE
#define MIVO_INLINE HWY_INLINE
#include "core/kernels/lens_formulas-inl.h"
//
#include "core/kernels/point_formulas-inl.h"
#undef MIVO_FORMULAS
#undef MIVO_INLINE
HWY_AFTER_NAMESPACE();
