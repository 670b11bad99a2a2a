// SPDX-License-Identifier: BSD-3-Clause
// Rows of depth images, included by vector.cpp once for each instruction set.

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {

inline void depthRow(const DepthView& depth, int y, int first, int width, float lowest,
                     float highest, float* meters) {
  const Floats d;
  const hn::Rebind<std::uint16_t, Floats> d16;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const std::ptrdiff_t row = y * depth.stride;
  int x = first;
  for (; x + lanes <= width; x += lanes) {
    FloatVector z;
    if (depth.meters != nullptr) {
      z = hn::LoadU(d, depth.meters + row + x);
    } else {
      const auto steps = hn::PromoteTo(Integers(), hn::LoadU(d16, depth.steps + row + x));
      z = hn::Mul(hn::ConvertTo(d, steps), all(depth.unit));
    }
    // Comparisons with NaN are false, so that NaN is no reading.
    const FloatMask is_reading = hn::And(hn::Ge(z, all(lowest)), hn::Le(z, all(highest)));
    hn::StoreU(hn::IfThenElseZero(is_reading, z), d, meters + x);
  }
  reference::depthRow(depth, y, x, width, lowest, highest, meters);
}

/// Sum and number of the readings on the surface of the middle one.
struct SurfaceMean {
  FloatVector sum, count;
};

HWY_INLINE void addReading(FloatVector z, FloatVector center, FloatVector bound,
                           SurfaceMean& mean) {
  const FloatMask is_on_surface = hn::Le(hn::Abs(hn::Sub(z, center)), bound);
  mean.sum = hn::Add(mean.sum, hn::IfThenElseZero(is_on_surface, z));
  mean.count = hn::Add(mean.count, hn::IfThenElseZero(is_on_surface, all(1.0F)));
}

inline void reduceDepthRow(const DepthRows& fine, int width, float ratio, int first,
                           float* coarse) {
  const Floats d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  if (first == 0 && width > 0) {
    // The first pixel has no left neighbor: the reference handles it.
    reference::reduceDepthRow(fine, std::min(width, 2), ratio, 0, coarse);
    first = 1;
  }
  int x = first;
  for (; 2 * (x + lanes) <= width; x += lanes) {
    FloatVector center, unused;
    hn::LoadInterleaved2(d, fine.row[fine.middle] + 2 * x, center, unused);
    const FloatVector bound = hn::Mul(all(ratio), center);
    SurfaceMean mean = {hn::Zero(d), hn::Zero(d)};
    for (int r = 0; r < fine.count; ++r) {
      FloatVector left, middle, right;
      hn::LoadInterleaved2(d, fine.row[r] + 2 * x - 2, unused, left);
      hn::LoadInterleaved2(d, fine.row[r] + 2 * x, middle, right);
      addReading(left, center, bound, mean);
      addReading(middle, center, bound, mean);
      addReading(right, center, bound, mean);
    }
    const FloatMask has_reading = hn::Gt(center, all(0.0F));
    hn::StoreU(hn::IfThenElseZero(has_reading, hn::Div(mean.sum, mean.count)), d, coarse + x);
  }
  reference::reduceDepthRow(fine, width, ratio, x, coarse);
}

inline void keepSmooth(const float* const depth[3], int width, float edge_ratio, int first,
                       std::uint8_t* candidates) {
  const Floats d;
  const hn::Rebind<std::uint8_t, Floats> d8;
  // Vectors may overlap, for rejecting a candidate twice changes nothing.
  const auto keep = [&](int x) HWY_ATTR {
    const FloatVector center = hn::LoadU(d, depth[1] + x);
    FloatVector lowest = center;
    FloatVector highest = center;
    for (int r = 0; r < 3; ++r) {
      for (int u = -1; u <= 1; ++u) {
        const FloatVector z = hn::LoadU(d, depth[r] + x + u);
        lowest = hn::Min(lowest, z);
        highest = hn::Max(highest, z);
      }
    }
    const FloatMask is_smooth =
        hn::And(hn::Gt(lowest, all(0.0F)),
                hn::Le(hn::Sub(highest, lowest), hn::Mul(all(edge_ratio), center)));
    const auto flag =
        hn::IfThenElseZero(hn::RebindMask(Integers(), is_smooth), hn::Set(Integers(), 1));
    const auto kept = hn::And(hn::LoadU(d8, candidates + x), hn::DemoteTo(d8, flag));
    hn::StoreU(kept, d8, candidates + x);
  };
  const int rest = forWholeVectors(first, width - 1, keep);
  reference::keepSmooth(depth, width, edge_ratio, rest, candidates);
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo
HWY_AFTER_NAMESPACE();
