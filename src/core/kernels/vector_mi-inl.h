// SPDX-License-Identifier: BSD-3-Clause
// Mutual information, included by vector.cpp once for each instruction set.

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {

inline void binPositions(const float* value, std::size_t n, float low, float scale, float top,
                         std::int32_t* bin, float* fraction) {
  const Floats d;
  const Integers di;
  const std::size_t whole = wholeVectors(n);
  for (std::size_t i = 0; i < whole; i += hn::Lanes(d)) {
    const FloatVector wanted = hn::Mul(hn::Sub(hn::LoadU(d, value + i), all(low)), all(scale));
    const FloatVector position = hn::Min(hn::Max(wanted, all(0.0F)), all(top));
    const auto whole_bin = hn::ConvertTo(di, position);  // not negative, so truncating rounds down
    hn::StoreU(whole_bin, di, bin + i);
    hn::StoreU(hn::Sub(position, hn::ConvertTo(d, whole_bin)), d, fraction + i);
  }
  reference::binPositions(value + whole, n - whole, low, scale, top, bin + whole, fraction + whole);
}

// The four weights of a cubic B-spline, see bspline.h.
struct VectorWeights {
  FloatVector w0, w1, w2, w3;
};

HWY_INLINE VectorWeights weightsAt(FloatVector t) {
  const FloatVector sixth = all(1.0F / 6.0F);
  const FloatVector rest = hn::Sub(all(1.0F), t);
  const FloatVector t2 = hn::Mul(t, t);
  const FloatVector rest2 = hn::Mul(rest, rest);
  const FloatVector two_thirds = all(2.0F / 3.0F);
  return {hn::Mul(hn::Mul(rest2, rest), sixth),
          hn::MulAdd(t2, hn::MulSub(all(0.5F), t, all(1.0F)), two_thirds),
          hn::MulAdd(rest2, hn::MulSub(all(0.5F), rest, all(1.0F)), two_thirds),
          hn::Mul(hn::Mul(t2, t), sixth)};
}

HWY_INLINE VectorWeights derivativesAt(FloatVector t) {
  const FloatVector rest = hn::Sub(all(1.0F), t);
  return {hn::Mul(all(-0.5F), hn::Mul(rest, rest)), hn::Mul(t, hn::MulSub(all(1.5F), t, all(2.0F))),
          hn::NegMulAdd(all(1.5F), hn::Mul(t, t), hn::Add(t, all(0.5F))),
          hn::Mul(all(0.5F), hn::Mul(t, t))};
}

HWY_INLINE VectorWeights secondDerivativesAt(FloatVector t) {
  return {hn::Sub(all(1.0F), t), hn::MulSub(all(3.0F), t, all(2.0F)),
          hn::NegMulAdd(all(3.0F), t, all(1.0F)), t};
}

/// The inputs of the loops over points, interleaved per point.
HWY_INLINE void store(const VectorWeights& w, float* places) {
  hn::StoreInterleaved4(w.w0, w.w1, w.w2, w.w3, Floats(), places);
}

HWY_INLINE VectorWeights times(FloatVector factor, const VectorWeights& w) {
  return {hn::Mul(factor, w.w0), hn::Mul(factor, w.w1), hn::Mul(factor, w.w2),
          hn::Mul(factor, w.w3)};
}

using Four = hn::FixedTag<float, 4>;

// The 4 x 4 products of weights are summed in one block per pair of bins. Blocks are whole vectors
// and never overlap, so that a load can use the value just stored. Points alternate between two
// tables, because neighboring points often belong to the same block. At the end the blocks are
// added to the bins of the histogram.
inline void jointHistogram(const BinsView& reference, const BinsView& live, const float* visible,
                           std::size_t n, int side, float* scratch, double* sums) {
  constexpr std::size_t kBlock = 16;
  const Floats d;
  const Four four;
  const std::size_t whole = wholeVectors(n);
  const auto cells = static_cast<std::size_t>(side - 3);
  const std::size_t table = kBlock * cells * cells;
  std::memset(scratch, 0, 2 * table * sizeof(float));
  alignas(64) float r[4 * kTile];
  alignas(64) float l[4 * kTile];
  for (std::size_t begin = 0; begin < whole; begin += kTile) {
    const std::size_t count = std::min(kTile, whole - begin);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
      const std::size_t at = begin + i;
      const FloatVector one = hn::IfThenElseZero(visibleAt(visible, at), all(1.0F));
      store(times(one, weightsAt(hn::LoadU(d, reference.fraction + at))), r + 4 * i);
      store(weightsAt(hn::LoadU(d, live.fraction + at)), l + 4 * i);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = begin + i;
      const std::size_t cell = static_cast<std::size_t>(reference.bin[at]) * cells +
                               static_cast<std::size_t>(live.bin[at]);
      float* block = scratch + (at & 1) * table + kBlock * cell;
      const auto weights = hn::Load(four, l + 4 * i);
      for (std::size_t a = 0; a < 4; ++a, block += 4) {
        const auto weight = hn::Set(four, r[4 * i + a]);
        hn::StoreU(hn::MulAdd(weight, weights, hn::LoadU(four, block)), four, block);
      }
    }
  }
  for (std::size_t cell = 0; cell < cells * cells; ++cell) {
    const float* first = scratch + kBlock * cell;
    const float* second = first + table;
    double* row = sums + cell / cells * static_cast<std::size_t>(side) + cell % cells;
    for (std::size_t a = 0; a < 4; ++a, row += side) {
      for (std::size_t b = 0; b < 4; ++b) {
        row[b] += static_cast<double>(first[4 * a + b] + second[4 * a + b]);
      }
    }
  }
  reference::jointHistogram({reference.bin + whole, reference.fraction + whole},
                            {live.bin + whole, live.fraction + whole}, visible + whole, n - whole,
                            side, scratch, sums);
}

inline void logarithms(const double* value, std::size_t n, double* logarithm) {
  const hn::ScalableTag<double> d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d)) {
    const auto x = hn::LoadU(d, value + i);
    const auto is_positive = hn::Gt(x, hn::Zero(d));
    const auto safe = hn::IfThenElse(is_positive, x, hn::Set(d, 1.0));
    hn::StoreU(hn::IfThenElseZero(is_positive, hn::Log(d, safe)), d, logarithm + i);
  }
  reference::logarithms(value + i, n - i, logarithm + i);
}

/// g and h of a tile of points, and their contribution to dp_rl.
struct alignas(64) MiTile {
  float first[4 * kTile];
  float second[4 * kTile];
  float live[4 * kTile];
  float g[4 * kTile];  // four partial sums per point
  float h[4 * kTile];
  float moments[4 * kRowFloats * kTile];  // the four live weights times the Jacobian
};

HWY_INLINE void weighTile(const BinsView& reference, const BinsView& live, const float* active,
                          std::size_t begin, std::size_t count, MiTile& tile) {
  const Floats d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const std::size_t at = begin + i;
    const FloatVector t = hn::LoadU(d, reference.fraction + at);
    const FloatVector one = hn::IfThenElseZero(visibleAt(active, at), all(1.0F));
    store(times(one, derivativesAt(t)), tile.first + 4 * i);
    store(times(one, secondDerivativesAt(t)), tile.second + 4 * i);
    store(weightsAt(hn::LoadU(d, live.fraction + at)), tile.live + 4 * i);
  }
}

HWY_INLINE void multiplyTile(const float* jacobian_rows, std::size_t begin, std::size_t count,
                             MiTile& tile) {
  const hn::CappedTag<float, kRowFloats> wide;
  float* moments = tile.moments;
  for (std::size_t i = 0; i < count; ++i) {
    const float* J = jacobian_rows + (begin + i) * kRowFloats;
    for (std::size_t b = 0; b < 4; ++b, moments += kRowFloats) {
      const auto weight = hn::Set(wide, tile.live[4 * i + b]);
      for (std::size_t k = 0; k < kRowFloats; k += hn::Lanes(wide)) {
        hn::Store(hn::Mul(weight, hn::LoadU(wide, J + k)), wide, moments + k);
      }
    }
  }
}

HWY_INLINE void spreadTile(const BinsView& reference, const BinsView& live, std::size_t begin,
                           std::size_t count, int side, const float* log_ratio, float* rows,
                           MiTile& tile) {
  // The rows of the four live bins are contiguous: they are updated by whole vectors.
  constexpr std::size_t kMoments = 4 * kRowFloats;
  const Four four;
  const hn::CappedTag<float, 16> wide;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = begin + i;
    const float* moments = tile.moments + kMoments * i;
    const auto weights = hn::Load(four, tile.live + 4 * i);
    auto g = hn::Zero(four);
    auto h = hn::Zero(four);
    std::ptrdiff_t entry = std::ptrdiff_t{reference.bin[at]} * side + live.bin[at];
    for (std::size_t a = 0; a < 4; ++a, entry += side) {
      const float first = tile.first[4 * i + a];
      const auto ratios = hn::Mul(weights, hn::LoadU(four, log_ratio + entry));
      g = hn::MulAdd(hn::Set(four, first), ratios, g);
      h = hn::MulAdd(hn::Set(four, tile.second[4 * i + a]), ratios, h);
      float* row = rows + entry * kRowFloats;
      const auto factor = hn::Set(wide, first);
      for (std::size_t k = 0; k < kMoments; k += hn::Lanes(wide)) {
        hn::StoreU(hn::MulAdd(factor, hn::Load(wide, moments + k), hn::LoadU(wide, row + k)), wide,
                   row + k);
      }
    }
    hn::Store(g, four, tile.g + 4 * i);
    hn::Store(h, four, tile.h + 4 * i);
  }
}

HWY_INLINE FloatVector sumOfFour(const float* parts) {
  FloatVector a, b, c, e;
  hn::LoadInterleaved4(Floats(), parts, a, b, c, e);
  return hn::Add(hn::Add(a, b), hn::Add(c, e));
}

/// Sums per vector lane over several tiles.
struct MiParts {
  FloatVector gradient[6];
  FloatVector curvature[21];
};

HWY_INLINE void clear(MiParts& parts) {
  for (FloatVector& part : parts.gradient) part = hn::Zero(Floats());
  for (FloatVector& part : parts.curvature) part = hn::Zero(Floats());
}

HWY_INLINE void addUp(MiParts& parts, MiSums& sums) {
  for (int k = 0; k < 6; ++k) sums.gradient[k] += total(parts.gradient[k]);
  for (int k = 0; k < 21; ++k) sums.curvature[k] += total(parts.curvature[k]);
  clear(parts);
}

HWY_INLINE void sumTile(const MiTile& tile, const float* const jacobian[6],
                        const float* const second_derivative[21], float bin_scale,
                        std::size_t begin, std::size_t count, MiParts& parts) {
  const Floats d;
  FloatVector gradient[6];
  FloatVector curvature[21];
  std::copy(parts.gradient, parts.gradient + 6, gradient);
  std::copy(parts.curvature, parts.curvature + 21, curvature);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const std::size_t at = begin + i;
    const FloatVector g = sumOfFour(tile.g + 4 * i);
    const FloatVector h = hn::Mul(all(bin_scale), sumOfFour(tile.h + 4 * i));
    int entry = 0;
    for (int row = 0; row < 6; ++row) {
      const FloatVector J = hn::LoadU(d, jacobian[row] + at);
      const FloatVector weighted = hn::Mul(h, J);
      gradient[row] = hn::MulAdd(g, J, gradient[row]);
      for (int column = row; column < 6; ++column, ++entry) {
        const FloatVector product =
            hn::MulAdd(weighted, hn::LoadU(d, jacobian[column] + at), curvature[entry]);
        curvature[entry] = hn::MulAdd(g, hn::LoadU(d, second_derivative[entry] + at), product);
      }
    }
  }
  std::copy(gradient, gradient + 6, parts.gradient);
  std::copy(curvature, curvature + 21, parts.curvature);
}

inline void miDerivatives(const BinsView& reference, const BinsView& live, const float* active,
                          const float* jacobian_rows, const float* const jacobian[6],
                          const float* const second_derivative[21], std::size_t n, int side,
                          float bin_scale, const float* log_ratio, float* rows, MiSums& sums) {
  const std::size_t whole = wholeVectors(n);
  const float* J[6];
  const float* S[21];
  for (int k = 0; k < 6; ++k) J[k] = jacobian[k] + whole;
  for (int k = 0; k < 21; ++k) S[k] = second_derivative[k] + whole;
  reference::miDerivatives({reference.bin + whole, reference.fraction + whole},
                           {live.bin + whole, live.fraction + whole}, active + whole,
                           jacobian_rows + whole * kRowFloats, J, S, n - whole, side, bin_scale,
                           log_ratio, rows, sums);
  MiTile tile;
  MiParts parts;
  clear(parts);
  for (std::size_t begin = 0; begin < whole; begin += kTile) {
    const std::size_t count = std::min(kTile, whole - begin);
    weighTile(reference, live, active, begin, count, tile);
    multiplyTile(jacobian_rows, begin, count, tile);
    spreadTile(reference, live, begin, count, side, log_ratio, rows, tile);
    sumTile(tile, jacobian, second_derivative, bin_scale, begin, count, parts);
    if ((begin + count) % kSumLength == 0 || begin + count == whole) addUp(parts, sums);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo
HWY_AFTER_NAMESPACE();
