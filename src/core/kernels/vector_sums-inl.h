// SPDX-License-Identifier: BSD-3-Clause
// Residuals and their sums, included by vector.cpp once for each instruction set. At most
// kSumLength points are summed in float; these sums are added in double.

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {

constexpr std::size_t kSumLength = 512;

HWY_INLINE double total(FloatVector v) {
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(Floats(), v)));
}

inline void residuals(const float* live, const float* contrast, const float* reference,
                      const float* visible, std::size_t n, float* residual) {
  const Floats d;
  const std::size_t whole = wholeVectors(n);
  for (std::size_t i = 0; i < whole; i += hn::Lanes(d)) {
    const FloatVector r =
        hn::MulSub(hn::LoadU(d, contrast + i), hn::LoadU(d, live + i), hn::LoadU(d, reference + i));
    hn::StoreU(hn::IfThenElseZero(visibleAt(visible, i), r), d, residual + i);
  }
  reference::residuals(live + whole, contrast + whole, reference + whole, visible + whole,
                       n - whole, residual + whole);
}

template <RobustWeight kKind>
using Kind = std::integral_constant<RobustWeight, kKind>;

/// Calls a function with the kind as a compile-time constant.
template <typename Function>
HWY_INLINE void withKind(RobustWeight kind, const Function& function) {
  switch (kind) {
    case RobustWeight::kHuber:
      return function(Kind<RobustWeight::kHuber>());
    case RobustWeight::kTukey:
      return function(Kind<RobustWeight::kTukey>());
    case RobustWeight::kStudentT:
      return function(Kind<RobustWeight::kStudentT>());
    case RobustWeight::kNone:
      return function(Kind<RobustWeight::kNone>());
  }
}

// Losses (that of Student's t is below) and weights as in robust_weight.h, which explains the
// constants.
template <RobustWeight kKind>
HWY_INLINE FloatVector lossOf(FloatVector u) {
  static_assert(kKind != RobustWeight::kStudentT, "studentCost sums those");
  const FloatVector half_square = hn::Mul(hn::Mul(all(0.5F), u), u);
  if (kKind == RobustWeight::kHuber) {
    const FloatVector magnitude = hn::Abs(u);
    const FloatVector linear = hn::MulSub(all(kHuber), magnitude, all(0.5F * kHuber * kHuber));
    return hn::IfThenElse(hn::Le(magnitude, all(kHuber)), half_square, linear);
  }
  if (kKind == RobustWeight::kTukey) {
    const FloatVector ratio = hn::Mul(u, all(1.0F / kTukey));
    const FloatVector rest = hn::Max(hn::NegMulAdd(ratio, ratio, all(1.0F)), all(0.0F));
    const FloatVector cube = hn::Mul(hn::Mul(rest, rest), rest);
    return hn::Mul(all(kTukey * kTukey / 6.0F), hn::Sub(all(1.0F), cube));
  }
  return half_square;
}

template <RobustWeight kKind>
HWY_INLINE FloatVector weightOf(FloatVector u) {
  if (kKind == RobustWeight::kHuber) {
    // u = 0 gives infinity, and thus 1.
    return hn::Min(all(1.0F), hn::Div(all(kHuber), hn::Abs(u)));
  }
  if (kKind == RobustWeight::kTukey) {
    const FloatVector ratio = hn::Mul(u, all(1.0F / kTukey));
    const FloatVector rest = hn::Max(hn::NegMulAdd(ratio, ratio, all(1.0F)), all(0.0F));
    return hn::Mul(rest, rest);
  }
  if (kKind == RobustWeight::kStudentT) {
    return hn::Div(all(kFreedom + 1.0F), hn::MulAdd(u, u, all(kFreedom)));
  }
  return all(1.0F);
}

/// Sum of the Student's t losses of several residuals, by the logarithm of a product. Each factor
/// is bounded, at residuals of 10^4 scales, so that the product does not overflow.
constexpr std::size_t kFactors = 4;

HWY_INLINE FloatVector studentFactor(FloatVector u, FloatMask is_visible) {
  const FloatVector square = hn::Mul(hn::Mul(u, u), all(1.0F / kFreedom));
  const FloatVector factor = hn::Min(hn::Add(square, all(1.0F)), all(1e9F));
  return hn::IfThenElse(is_visible, factor, all(1.0F));
}

HWY_INLINE double studentCost(float inverse_scale, const float* residual, const float* visible,
                              std::size_t n) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  const auto factorAt = [&](std::size_t i) {
    return studentFactor(hn::Mul(hn::LoadU(d, residual + i), all(inverse_scale)),
                         visibleAt(visible, i));
  };
  double result = 0.0;
  for (std::size_t begin = 0; begin < n; begin += kSumLength) {
    const std::size_t end = std::min(n, begin + kSumLength);
    FloatVector part = hn::Zero(d);
    std::size_t i = begin;
    for (; i + kFactors * lanes <= end; i += kFactors * lanes) {
      const FloatVector first = hn::Mul(factorAt(i), factorAt(i + lanes));
      const FloatVector second = hn::Mul(factorAt(i + 2 * lanes), factorAt(i + 3 * lanes));
      part = hn::Add(part, hn::Log(d, hn::Mul(first, second)));
    }
    for (; i < end; i += lanes) part = hn::Add(part, hn::Log(d, factorAt(i)));
    result += total(part);
  }
  return 0.5 * (static_cast<double>(kFreedom) + 1.0) * result;
}

template <RobustWeight kKind>
HWY_INLINE double costOf(float inverse_scale, const float* residual, const float* visible,
                         std::size_t n) {
  const Floats d;
  double result = 0.0;
  for (std::size_t begin = 0; begin < n; begin += kSumLength) {
    const std::size_t end = std::min(n, begin + kSumLength);
    FloatVector part = hn::Zero(d);
    for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
      const FloatVector loss =
          lossOf<kKind>(hn::Mul(hn::LoadU(d, residual + i), all(inverse_scale)));
      part = hn::Add(part, hn::IfThenElseZero(visibleAt(visible, i), loss));
    }
    result += total(part);
  }
  return result;
}

inline double robustCost(RobustWeight kind, float scale, const float* residual,
                         const float* visible, std::size_t n) {
  const std::size_t whole = wholeVectors(n);
  const float inverse_scale = 1.0F / scale;
  double cost = reference::robustCost(kind, scale, residual + whole, visible + whole, n - whole);
  withKind(kind, [&](auto constant) HWY_ATTR {
    constexpr RobustWeight kKind = decltype(constant)::value;
    if constexpr (kKind == RobustWeight::kStudentT) {
      cost += studentCost(inverse_scale, residual, visible, whole);
    } else {
      cost += costOf<kKind>(inverse_scale, residual, visible, whole);
    }
  });
  return cost;
}

template <RobustWeight kKind>
HWY_INLINE void weights(float inverse_scale, const float* residual, const float* visible,
                        std::size_t n, float* weight) {
  const Floats d;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const FloatVector w = weightOf<kKind>(hn::Mul(hn::LoadU(d, residual + i), all(inverse_scale)));
    hn::StoreU(hn::IfThenElseZero(visibleAt(visible, i), w), d, weight + i);
  }
}

inline void robustWeights(RobustWeight kind, float scale, const float* residual,
                          const float* visible, std::size_t n, float* weight) {
  const std::size_t whole = wholeVectors(n);
  const float inverse_scale = 1.0F / scale;
  reference::robustWeights(kind, scale, residual + whole, visible + whole, n - whole,
                           weight + whole);
  withKind(kind, [&](auto constant) HWY_ATTR {
    weights<decltype(constant)::value>(inverse_scale, residual, visible, whole, weight);
  });
}

/// Curvature of the loss, computed from its weight.
template <RobustWeight kKind>
HWY_INLINE FloatVector curvatureOf(FloatVector weight) {
  if (kKind == RobustWeight::kHuber) return hn::IfThenElseZero(hn::Ge(weight, all(1.0F)), weight);
  if (kKind == RobustWeight::kTukey) {
    return hn::MulSub(all(5.0F), weight, hn::Mul(all(4.0F), hn::Sqrt(weight)));
  }
  if (kKind == RobustWeight::kStudentT) {
    const FloatVector share = hn::Mul(weight, all(2.0F * kFreedom / (kFreedom + 1.0F)));
    return hn::Mul(weight, hn::Sub(share, all(1.0F)));
  }
  return weight;
}

template <RobustWeight kKind>
HWY_INLINE void accumulatePart(float inverse_scale, const float* residual, const float* visible,
                               const float* const jacobian[6], std::size_t begin, std::size_t end,
                               LeastSquaresSums& sums) {
  const Floats d;
  FloatVector gradient[6];
  FloatVector hessian[21];
  for (FloatVector& sum : gradient) sum = hn::Zero(d);
  for (FloatVector& sum : hessian) sum = hn::Zero(d);
  FloatVector weights = hn::Zero(d);
  FloatVector curvatures = hn::Zero(d);
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    const FloatMask mask = visibleAt(visible, i);
    const FloatVector r = hn::IfThenElseZero(mask, hn::LoadU(d, residual + i));
    const FloatVector weight =
        hn::IfThenElseZero(mask, weightOf<kKind>(hn::Mul(r, all(inverse_scale))));
    weights = hn::Add(weights, weight);
    curvatures = hn::Add(curvatures, hn::IfThenElseZero(mask, curvatureOf<kKind>(weight)));
    const FloatVector J[6] = {hn::LoadU(d, jacobian[0] + i), hn::LoadU(d, jacobian[1] + i),
                              hn::LoadU(d, jacobian[2] + i), hn::LoadU(d, jacobian[3] + i),
                              hn::LoadU(d, jacobian[4] + i), hn::LoadU(d, jacobian[5] + i)};
    int entry = 0;
    for (int row = 0; row < 6; ++row) {
      const FloatVector weighted = hn::Mul(weight, J[row]);
      gradient[row] = hn::MulAdd(weighted, r, gradient[row]);
      for (int column = row; column < 6; ++column, ++entry) {
        hessian[entry] = hn::MulAdd(weighted, J[column], hessian[entry]);
      }
    }
  }
  for (int k = 0; k < 6; ++k) sums.gradient[k] += total(gradient[k]);
  sums.weight += total(weights);
  sums.curvature += total(curvatures);
  for (int k = 0; k < 21; ++k) sums.hessian[k] += total(hessian[k]);
}

template <RobustWeight kKind>
HWY_INLINE void accumulate(float inverse_scale, const float* residual, const float* visible,
                           const float* const jacobian[6], std::size_t n, LeastSquaresSums& sums) {
  for (std::size_t begin = 0; begin < n; begin += kSumLength) {
    accumulatePart<kKind>(inverse_scale, residual, visible, jacobian, begin,
                          std::min(n, begin + kSumLength), sums);
  }
}

inline void accumulateLeastSquares(RobustWeight kind, float scale, const float* residual,
                                   const float* visible, const float* const jacobian[6],
                                   std::size_t n, LeastSquaresSums& sums) {
  const std::size_t whole = wholeVectors(n);
  const float inverse_scale = 1.0F / scale;
  const float* rest[6];
  for (int k = 0; k < 6; ++k) rest[k] = jacobian[k] + whole;
  reference::accumulateLeastSquares(kind, scale, residual + whole, visible + whole, rest, n - whole,
                                    sums);
  withKind(kind, [&](auto constant) HWY_ATTR {
    accumulate<decltype(constant)::value>(inverse_scale, residual, visible, jacobian, whole, sums);
  });
}

inline void sumPairs(const float* a, const float* b, const float* divisor, const float* visible,
                     std::size_t n, PairSums& sums) {
  const Floats d;
  const std::size_t whole = wholeVectors(n);
  reference::sumPairs(a + whole, b + whole, divisor + whole, visible + whole, n - whole, sums);
  for (std::size_t begin = 0; begin < whole; begin += kSumLength) {
    const std::size_t end = std::min(whole, begin + kSumLength);
    FloatVector sum_a = hn::Zero(d);
    FloatVector sum_b = hn::Zero(d);
    FloatVector sum_aa = hn::Zero(d);
    FloatVector sum_bb = hn::Zero(d);
    FloatVector sum_ab = hn::Zero(d);
    for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
      const FloatMask mask = visibleAt(visible, i);
      const FloatVector x = hn::IfThenElseZero(mask, hn::LoadU(d, a + i));
      const FloatVector y =
          hn::IfThenElseZero(mask, hn::Div(hn::LoadU(d, b + i), hn::LoadU(d, divisor + i)));
      sum_a = hn::Add(sum_a, x);
      sum_b = hn::Add(sum_b, y);
      sum_aa = hn::MulAdd(x, x, sum_aa);
      sum_bb = hn::MulAdd(y, y, sum_bb);
      sum_ab = hn::MulAdd(x, y, sum_ab);
    }
    sums.a += total(sum_a);
    sums.b += total(sum_b);
    sums.aa += total(sum_aa);
    sums.bb += total(sum_bb);
    sums.ab += total(sum_ab);
  }
}

/// Depth readings at the pixels nearest to the points of a tile.
HWY_INLINE void fetchReadings(const DepthView& depth, const std::int32_t* offset, std::size_t n,
                              float* reading) {
  if (depth.meters != nullptr) {
    for (std::size_t i = 0; i < n; ++i) reading[i] = depth.meters[offset[i]];
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      reading[i] = static_cast<float>(depth.steps[offset[i]]) * depth.unit;
    }
  }
}

/// One vector of geometricResiduals, with the depth readings z. Returns which points have one.
HWY_INLINE FloatMask geometricVector(const WarpParameters& live, const Motion& T_ref_live,
                                     const PlanesView& planes, std::size_t i, FloatVector u,
                                     FloatVector v, FloatVector z, FloatMask in_view,
                                     float* residual, float* const jacobian[6]) {
  const Floats d;
  const Integers di;
  const FloatMask mask =
      hn::And(in_view, hn::And(hn::Gt(z, all(0.0F)), hn::Lt(z, all(kMaxReading))));
  const VectorPoint X = load(planes.point, i);
  const VectorPoint N = load(planes.normal, i);
  VectorPoint q = moved(live.rotation, live.translation, X);
  VectorPoint shift = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  if (live.has_row_motion) {
    shift = rowShift(live, q, v);
    q = sum(q, shift);
  }
  const FloatVector column = hn::ConvertTo(d, hn::ConvertTo(di, hn::Add(u, all(0.5F))));
  const FloatVector row = hn::ConvertTo(d, hn::ConvertTo(di, hn::Add(v, all(0.5F))));
  const FloatVector inverse = hn::Div(all(1.0F), q.z);
  const Number x = {hn::Mul(q.x, inverse)};
  const Number y = {hn::Mul(q.y, inverse)};
  const NormalizedPoint step = beforeLens(live, {x, y},
                                          {{hn::Mul(hn::Sub(column, u), all(1.0F / live.fx))},
                                           {hn::Mul(hn::Sub(row, v), all(1.0F / live.fy))}});
  const VectorPoint Y = {hn::MulSub(z, hn::MulAdd(q.x, inverse, step.x.v), shift.x),
                         hn::MulSub(z, hn::MulAdd(q.y, inverse, step.y.v), shift.y),
                         hn::Sub(z, shift.z)};
  const VectorPoint P = moved(T_ref_live.rotation, T_ref_live.translation, Y);
  const FloatVector weight = hn::LoadU(d, planes.weight + i);
  const FloatVector distance = hn::MulAdd(
      N.x, hn::Sub(P.x, X.x), hn::MulAdd(N.y, hn::Sub(P.y, X.y), hn::Mul(N.z, hn::Sub(P.z, X.z))));
  hn::StoreU(hn::IfThenElseZero(mask, hn::Mul(weight, distance)), d, residual + i);
  const FloatVector minus = hn::IfThenElseZero(mask, hn::Neg(weight));
  const FloatVector turn_x = hn::MulSub(P.y, N.z, hn::Mul(P.z, N.y));
  const FloatVector turn_y = hn::MulSub(P.z, N.x, hn::Mul(P.x, N.z));
  const FloatVector turn_z = hn::MulSub(P.x, N.y, hn::Mul(P.y, N.x));
  const FloatVector columns[6] = {N.x, N.y, N.z, turn_x, turn_y, turn_z};
  for (int k = 0; k < 6; ++k) {
    hn::StoreU(hn::IfThenElseZero(mask, hn::Mul(minus, columns[k])), d, jacobian[k] + i);
  }
  return mask;
}

inline std::size_t geometricResiduals(const WarpParameters& live, const Motion& T_ref_live,
                                      const PlanesView& planes, const DepthView& depth,
                                      const float* u, const float* v, std::size_t n, float* visible,
                                      float* residual, float* const jacobian[6]) {
  const Floats d;
  const Integers di;
  const auto stride = hn::Set(di, static_cast<std::int32_t>(depth.stride));
  const std::size_t whole = wholeVectors(n);
  std::size_t count = 0;
  alignas(64) std::int32_t offset[kTile];
  alignas(64) float reading[kTile];
  for (std::size_t begin = 0; begin < whole; begin += kTile) {
    const std::size_t points = std::min(kTile, whole - begin);
    for (std::size_t i = 0; i < points; i += hn::Lanes(d)) {
      const auto column = hn::ConvertTo(di, hn::Add(hn::LoadU(d, u + begin + i), all(0.5F)));
      const auto row = hn::ConvertTo(di, hn::Add(hn::LoadU(d, v + begin + i), all(0.5F)));
      hn::Store(hn::Add(hn::Mul(row, stride), column), di, offset + i);
    }
    fetchReadings(depth, offset, points, reading);
    for (std::size_t i = 0; i < points; i += hn::Lanes(d)) {
      const std::size_t at = begin + i;
      const FloatMask mask =
          geometricVector(live, T_ref_live, planes, at, hn::LoadU(d, u + at), hn::LoadU(d, v + at),
                          hn::Load(d, reading + i), visibleAt(visible, at), residual, jacobian);
      hn::StoreU(hn::IfThenElseZero(mask, all(1.0F)), d, visible + at);
      count += hn::CountTrue(d, mask);
    }
  }
  float* rest[6];
  for (int k = 0; k < 6; ++k) rest[k] = jacobian[k] + whole;
  const PlanesView last = {
      {planes.point.x + whole, planes.point.y + whole, planes.point.z + whole},
      {planes.normal.x + whole, planes.normal.y + whole, planes.normal.z + whole},
      planes.weight + whole};
  return count + reference::geometricResiduals(live, T_ref_live, last, depth, u + whole, v + whole,
                                               n - whole, visible + whole, residual + whole, rest);
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo
HWY_AFTER_NAMESPACE();
