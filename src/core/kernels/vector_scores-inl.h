// SPDX-License-Identifier: BSD-3-Clause
// Scores of the blocks of an image, included by vector.cpp once for each instruction set.

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {

/// The terms a tile of points adds to its blocks: a BlockScore per point, in two halves.
struct alignas(64) TileScores {
  std::int32_t block[kTile];
  float first[4 * kTile];   // scores 0 to 3
  float second[4 * kTile];  // scores 4 and 5, `visible`, 0
};

template <RobustWeight kKind>
HWY_INLINE void scoreTile(float inverse_scale, const float* residual, const float* visible,
                          const float* const jacobian[6], const float* u, const float* v,
                          std::size_t begin, std::size_t n, const BlockGrid& grid,
                          TileScores& tile) {
  const Floats d;
  const Integers di;
  const auto columns = hn::Set(di, grid.columns);
  const FloatVector per_pixel = all(grid.per_pixel);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const std::size_t at = begin + i;
    const auto column = hn::ConvertTo(di, hn::Mul(hn::LoadU(d, u + at), per_pixel));
    const auto row = hn::ConvertTo(di, hn::Mul(hn::LoadU(d, v + at), per_pixel));
    hn::Store(hn::Add(hn::Mul(row, columns), column), di, tile.block + i);
    const FloatMask mask = visibleAt(visible, at);
    const FloatVector r = hn::IfThenElseZero(mask, hn::LoadU(d, residual + at));
    const FloatVector weight = weightOf<kKind>(hn::Mul(r, all(inverse_scale)));
    const FloatVector influence = hn::IfThenElseZero(mask, hn::Mul(weight, r));
    const auto score = [&](int k)
                           HWY_ATTR { return hn::Mul(influence, hn::LoadU(d, jacobian[k] + at)); };
    hn::StoreInterleaved4(score(0), score(1), score(2), score(3), d, tile.first + 4 * i);
    hn::StoreInterleaved4(score(4), score(5), hn::IfThenElseZero(mask, all(1.0F)), hn::Zero(d), d,
                          tile.second + 4 * i);
  }
}

inline void accumulateScores(RobustWeight kind, float scale, const float* residual,
                             const float* visible, const float* const jacobian[6], const float* u,
                             const float* v, std::size_t n, const BlockGrid& grid,
                             BlockScore* blocks) {
  const hn::FixedTag<float, 4> four;
  const std::size_t whole = wholeVectors(n);
  const float inverse_scale = 1.0F / scale;
  TileScores tile;
  withKind(kind, [&](auto constant) HWY_ATTR {
    for (std::size_t begin = 0; begin < whole; begin += kTile) {
      const std::size_t count = std::min(kTile, whole - begin);
      scoreTile<decltype(constant)::value>(inverse_scale, residual, visible, jacobian, u, v, begin,
                                           count, grid, tile);
      for (std::size_t i = 0; i < count; ++i) {
        float* block = blocks[tile.block[i]].score;
        const auto first = hn::Add(hn::LoadU(four, block), hn::Load(four, tile.first + 4 * i));
        const auto second =
            hn::Add(hn::LoadU(four, block + 4), hn::Load(four, tile.second + 4 * i));
        hn::StoreU(first, four, block);
        hn::StoreU(second, four, block + 4);
      }
    }
  });
  const float* rest[6];
  for (int k = 0; k < 6; ++k) rest[k] = jacobian[k] + whole;
  reference::accumulateScores(kind, scale, residual + whole, visible + whole, rest, u + whole,
                              v + whole, n - whole, grid, blocks);
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo
HWY_AFTER_NAMESPACE();
