// SPDX-License-Identifier: BSD-3-Clause
#include "core/kernels/vector.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/kernels/scalar.h"
#include "core/terms/robust_weight.h"

// One source for all instruction sets: Highway includes this file, and the parts it includes, once
// for each of them, with HWY_NAMESPACE and the vector types defined accordingly. The parts
// therefore have no include guards.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/vector.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>
// Highway's logarithm and arc tangent.
#include <hwy/contrib/math/math-inl.h>

// Without vector instructions the reference is used.
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#include "core/kernels/vector_points-inl.h"
//
#include "core/kernels/vector_formulas-inl.h"
//
#include "core/kernels/vector_sums-inl.h"
//
#include "core/kernels/vector_scores-inl.h"
//
#include "core/kernels/vector_mi-inl.h"
//
#include "core/kernels/vector_images-inl.h"
//
#include "core/kernels/vector_keyframe-inl.h"
//
#include "core/kernels/vector_depth-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {

const Kernels& table() {
  static const Kernels kernels = {
      warpPoints,
      sampleIntensity,
      sampleNormalized,
      residuals,
      robustCost,
      robustWeights,
      accumulateLeastSquares,
      accumulateScores,
      sumPairs,
      geometricResiduals,
      binPositions,
      jointHistogram,
      logarithms,
      miDerivatives,
      reduce,
      smooth,
      contrastMap,
      normalizeImage,
      gradientRow,
      maximaRow,
      depthRow,
      reduceDepthRow,
      keepSmooth,
      keyframePoints,
  };
  return kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace mivo {
namespace kernels {

std::vector<Backend> vectorBackends() {
  std::vector<Backend> result;
  const std::int64_t supported = hwy::SupportedTargets();
  (void)supported;  // unused where only one instruction set is built
#if HWY_TARGETS & HWY_NEON
  if ((supported & HWY_NEON) != 0) result.push_back({"NEON", &N_NEON::table()});
#endif
#if HWY_TARGETS & HWY_SSE4
  if ((supported & HWY_SSE4) != 0) result.push_back({"SSE4", &N_SSE4::table()});
#endif
#if HWY_TARGETS & HWY_AVX2
  if ((supported & HWY_AVX2) != 0) result.push_back({"AVX2", &N_AVX2::table()});
#endif
#if HWY_TARGETS & HWY_AVX3
  if ((supported & HWY_AVX3) != 0) result.push_back({"AVX3", &N_AVX3::table()});
#endif
  return result;
}

}  // namespace kernels
}  // namespace mivo
#endif
