// SPDX-License-Identifier: BSD-3-Clause
// Warp and samples, included by vector.cpp once for each instruction set.

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Integers = hn::RebindToSigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using FloatMask = hn::Mask<Floats>;

HWY_INLINE FloatVector all(float value) {
  return hn::Set(Floats(), value);
}

/// The points that fill whole vectors; the reference handles the rest.
HWY_INLINE std::size_t wholeVectors(std::size_t n) {
  return n - n % hn::Lanes(Floats());
}

struct VectorPoint {
  FloatVector x, y, z;
};

HWY_INLINE FloatVector rowTimes(const float* row, const VectorPoint& p, float offset) {
  return hn::MulAdd(all(row[0]), p.x,
                    hn::MulAdd(all(row[1]), p.y, hn::MulAdd(all(row[2]), p.z, all(offset))));
}

HWY_INLINE VectorPoint moved(const float* rotation, const float* translation,
                             const VectorPoint& p) {
  return {rowTimes(rotation, p, translation[0]), rowTimes(rotation + 3, p, translation[1]),
          rowTimes(rotation + 6, p, translation[2])};
}

HWY_INLINE VectorPoint load(const PointsView& points, std::size_t i) {
  const Floats d;
  return {hn::LoadU(d, points.x + i), hn::LoadU(d, points.y + i), hn::LoadU(d, points.z + i)};
}

/// Motion of the points until row v is read.
HWY_INLINE VectorPoint rowShift(const WarpParameters& p, const VectorPoint& q, FloatVector v) {
  const FloatVector tau = hn::MulAdd(v, all(p.row_duration), all(p.first_row));
  const FloatVector wx = all(p.angular[0]);
  const FloatVector wy = all(p.angular[1]);
  const FloatVector wz = all(p.angular[2]);
  const FloatVector x = hn::NegMulAdd(wz, q.y, hn::MulAdd(wy, q.z, all(p.linear[0])));
  const FloatVector y = hn::NegMulAdd(wx, q.z, hn::MulAdd(wz, q.x, all(p.linear[1])));
  const FloatVector z = hn::NegMulAdd(wy, q.x, hn::MulAdd(wx, q.y, all(p.linear[2])));
  return {hn::Mul(tau, x), hn::Mul(tau, y), hn::Mul(tau, z)};
}

HWY_INLINE VectorPoint sum(const VectorPoint& a, const VectorPoint& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

struct VectorPixel {
  FloatVector u, v;
  FloatMask is_valid;
};

/// The factor of radial distortion.
template <Lens kLens>
HWY_INLINE FloatVector radialScale(const WarpParameters& p, FloatVector r2) {
  if (kLens == Lens::kEquidistant) {
    const FloatVector r = hn::Sqrt(hn::Add(r2, all(1e-12F)));
    const FloatVector angle = hn::Atan(Floats(), r);
    const FloatVector a2 = hn::Mul(angle, angle);
    const FloatVector series = hn::MulAdd(
        a2,
        hn::MulAdd(a2, hn::MulAdd(a2, hn::MulAdd(a2, all(p.k4), all(p.k3)), all(p.k2)), all(p.k1)),
        all(1.0F));
    return hn::Div(hn::Mul(angle, series), r);
  }
  const FloatVector over =
      hn::MulAdd(r2, hn::MulAdd(r2, hn::MulAdd(r2, all(p.k3), all(p.k2)), all(p.k1)), all(1.0F));
  if (kLens == Lens::kPlumbBob) return over;
  const FloatVector under =
      hn::MulAdd(r2, hn::MulAdd(r2, hn::MulAdd(r2, all(p.k6), all(p.k5)), all(p.k4)), all(1.0F));
  return hn::Div(over, under);
}

template <Lens kLens>
HWY_INLINE VectorPixel project(const WarpParameters& p, const VectorPoint& q) {
  const FloatVector inverse = hn::Div(all(1.0F), q.z);
  FloatVector x = hn::Mul(q.x, inverse);
  FloatVector y = hn::Mul(q.y, inverse);
  FloatMask is_valid = hn::Gt(q.z, all(0.0F));
  if (kLens != Lens::kNone) {
    const FloatVector xx = hn::Mul(x, x);
    const FloatVector yy = hn::Mul(y, y);
    const FloatVector r2 = hn::Add(xx, yy);
    const FloatVector radial = radialScale<kLens>(p, r2);
    const FloatVector xy2 = hn::Mul(hn::Add(x, x), y);
    is_valid = hn::And(is_valid, hn::Le(r2, all(p.max_squared_radius)));
    const FloatVector tangential_x =
        hn::MulAdd(all(p.p1), xy2, hn::Mul(all(p.p2), hn::MulAdd(all(2.0F), xx, r2)));
    const FloatVector tangential_y =
        hn::MulAdd(all(p.p2), xy2, hn::Mul(all(p.p1), hn::MulAdd(all(2.0F), yy, r2)));
    x = hn::MulAdd(x, radial, tangential_x);
    y = hn::MulAdd(y, radial, tangential_y);
  }
  return {hn::MulAdd(all(p.fx), x, all(p.cx)), hn::MulAdd(all(p.fy), y, all(p.cy)), is_valid};
}

template <Lens kLens>
HWY_INLINE std::size_t warpVectors(const WarpParameters& p, const PointsView& points, std::size_t n,
                                   float* u, float* v, float* visible) {
  const Floats d;
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const VectorPoint q = moved(p.rotation, p.translation, load(points, i));
    VectorPixel pixel = project<kLens>(p, q);
    if (p.has_row_motion) pixel = project<kLens>(p, sum(q, rowShift(p, q, pixel.v)));
    // Comparisons with NaN are false, so that NaN is outside.
    const FloatMask right_of = hn::And(hn::Ge(pixel.u, all(0.0F)), hn::Ge(pixel.v, all(0.0F)));
    const FloatMask left_of =
        hn::And(hn::Lt(pixel.u, all(p.right)), hn::Lt(pixel.v, all(p.bottom)));
    const FloatMask is_visible = hn::And(pixel.is_valid, hn::And(right_of, left_of));
    hn::StoreU(hn::IfThenElseZero(is_visible, pixel.u), d, u + i);
    hn::StoreU(hn::IfThenElseZero(is_visible, pixel.v), d, v + i);
    hn::StoreU(hn::IfThenElseZero(is_visible, all(1.0F)), d, visible + i);
    count += hn::CountTrue(d, is_visible);
  }
  return count;
}

inline std::size_t warpPoints(const WarpParameters& p, const PointsView& points, std::size_t n,
                              float* u, float* v, float* visible) {
  const std::size_t whole = wholeVectors(n);
  std::size_t count = 0;
  switch (p.lens) {
    case Lens::kNone:
      count = warpVectors<Lens::kNone>(p, points, whole, u, v, visible);
      break;
    case Lens::kPlumbBob:
      count = warpVectors<Lens::kPlumbBob>(p, points, whole, u, v, visible);
      break;
    case Lens::kRational:
      count = warpVectors<Lens::kRational>(p, points, whole, u, v, visible);
      break;
    case Lens::kEquidistant:
      count = warpVectors<Lens::kEquidistant>(p, points, whole, u, v, visible);
      break;
  }
  count += reference::warpPoints(p, {points.x + whole, points.y + whole, points.z + whole},
                                 n - whole, u + whole, v + whole, visible + whole);
  return count;
}

// Gather instructions are slow on many processors and missing on others. So vectors compute the
// addresses, a scalar loop copies the neighbors of each point into a tile, and vectors interpolate.
constexpr std::size_t kTile = 64;

struct alignas(64) Corners {
  std::int32_t offset[kTile];
  float du[kTile];
  float dv[kTile];
};

/// `scale` times the pixels, split into integer part and fraction.
HWY_INLINE void findCorners(const float* u, const float* v, float scale, std::ptrdiff_t stride,
                            std::int32_t step, std::size_t n, Corners& corners) {
  const Floats d;
  const Integers di;
  const auto row_step = hn::Set(di, static_cast<std::int32_t>(stride));
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const FloatVector x = hn::Mul(all(scale), hn::LoadU(d, u + i));
    const FloatVector y = hn::Mul(all(scale), hn::LoadU(d, v + i));
    const auto column = hn::ConvertTo(di, x);  // not negative, so truncating rounds down
    const auto row = hn::ConvertTo(di, y);
    hn::Store(hn::Sub(x, hn::ConvertTo(d, column)), d, corners.du + i);
    hn::Store(hn::Sub(y, hn::ConvertTo(d, row)), d, corners.dv + i);
    const auto offset = hn::Add(hn::Mul(row, row_step), hn::Mul(column, hn::Set(di, step)));
    hn::Store(offset, di, corners.offset + i);
  }
}

/// The two horizontal neighbors of each point in a row of the image, interleaved.
struct alignas(64) FloatPairs {
  float upper[2 * kTile];
  float lower[2 * kTile];
};
struct alignas(64) BytePairs {
  std::uint16_t upper[kTile];
  std::uint16_t lower[kTile];
};

HWY_INLINE FloatVector interpolated(FloatVector a, FloatVector b, FloatVector t) {
  return hn::MulAdd(t, hn::Sub(b, a), a);
}

HWY_INLINE void fetch(const ImageView& image, const Corners& corners, std::size_t n,
                      FloatPairs& pairs) {
  for (std::size_t i = 0; i < n; ++i) {
    const float* upper = image.data + corners.offset[i];
    std::memcpy(pairs.upper + 2 * i, upper, 2 * sizeof(float));
    std::memcpy(pairs.lower + 2 * i, upper + image.stride, 2 * sizeof(float));
  }
}

HWY_INLINE void fetch(const ImageView& image, const Corners& corners, std::size_t n,
                      BytePairs& pairs) {
  for (std::size_t i = 0; i < n; ++i) {
    const unsigned char* upper = image.bytes + corners.offset[i];
    std::memcpy(pairs.upper + i, upper, 2);
    std::memcpy(pairs.lower + i, upper + image.stride, 2);
  }
}

/// Horizontal interpolation of the pairs from i on, in the upper and in the lower row.
struct Rows {
  FloatVector upper, lower;
};

HWY_INLINE Rows along(const FloatPairs& pairs, std::size_t i, FloatVector du) {
  const Floats d;
  FloatVector a, b, c, e;
  hn::LoadInterleaved2(d, pairs.upper + 2 * i, a, b);
  hn::LoadInterleaved2(d, pairs.lower + 2 * i, c, e);
  return {interpolated(a, b, du), interpolated(c, e, du)};
}

HWY_INLINE FloatVector along(const std::uint16_t* pairs, FloatVector du) {
  const Floats d;
  const Integers di;
  const hn::Rebind<std::uint16_t, Floats> d16;
  const auto both = hn::PromoteTo(di, hn::LoadU(d16, pairs));
  // All vector targets are little endian: the first byte in memory is the low one.
  const FloatVector first = hn::ConvertTo(d, hn::And(both, hn::Set(di, 0xFF)));
  const FloatVector second = hn::ConvertTo(d, hn::ShiftRight<8>(both));
  return interpolated(first, second, du);
}

HWY_INLINE Rows along(const BytePairs& pairs, std::size_t i, FloatVector du) {
  return {along(pairs.upper + i, du), along(pairs.lower + i, du)};
}

template <typename Pairs>
HWY_INLINE void sampleTile(const ImageView& image, const float* u, const float* v, std::size_t n,
                           float* intensity) {
  const Floats d;
  Corners corners;
  Pairs pairs;
  findCorners(u, v, 1.0F, image.stride, 1, n, corners);
  fetch(image, corners, n, pairs);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const Rows rows = along(pairs, i, hn::Load(d, corners.du + i));
    hn::StoreU(interpolated(rows.upper, rows.lower, hn::Load(d, corners.dv + i)), d, intensity + i);
  }
}

HWY_INLINE void sampleAny(const ImageView& image, const float* u, const float* v, std::size_t n,
                          float* intensity) {
  if (image.data != nullptr) {
    sampleTile<FloatPairs>(image, u, v, n, intensity);
  } else {
    sampleTile<BytePairs>(image, u, v, n, intensity);
  }
}

HWY_INLINE FloatMask visibleAt(const float* visible, std::size_t i) {
  return hn::Ne(hn::LoadU(Floats(), visible + i), all(0.0F));
}

inline void sampleIntensity(const ImageView& image, const float* u, const float* v,
                            const float* visible, std::size_t n, float* intensity) {
  const Floats d;
  const std::size_t whole = wholeVectors(n);
  for (std::size_t begin = 0; begin < whole; begin += kTile) {
    const std::size_t count = std::min(kTile, whole - begin);
    sampleAny(image, u + begin, v + begin, count, intensity + begin);
  }
  for (std::size_t i = 0; i < whole; i += hn::Lanes(d)) {
    hn::StoreU(hn::IfThenElseZero(visibleAt(visible, i), hn::LoadU(d, intensity + i)), d,
               intensity + i);
  }
  reference::sampleIntensity(image, u + whole, v + whole, visible + whole, n - whole,
                             intensity + whole);
}

inline std::size_t sampleNormalized(const ImageView& image, const ContrastView& contrast,
                                    float saturation, const float* u, const float* v,
                                    float* visible, std::size_t n, float* normalized) {
  const Floats d;
  std::size_t hidden = 0;
  const std::size_t whole = wholeVectors(n);
  Corners corners;
  alignas(64) float upper[4 * kTile];  // mean and deviation, here and one pixel to the right
  alignas(64) float lower[4 * kTile];
  for (std::size_t begin = 0; begin < whole; begin += kTile) {
    const std::size_t count = std::min(kTile, whole - begin);
    sampleAny(image, u + begin, v + begin, count, normalized + begin);
    findCorners(u + begin, v + begin, 0.25F, contrast.stride, 2, count, corners);
    for (std::size_t i = 0; i < count; ++i) {
      const float* pair = contrast.pairs + corners.offset[i];
      std::memcpy(upper + 4 * i, pair, 4 * sizeof(float));
      std::memcpy(lower + 4 * i, pair + contrast.stride, 4 * sizeof(float));
    }
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
      FloatVector m0, s0, m1, s1, m2, s2, m3, s3;
      hn::LoadInterleaved4(d, upper + 4 * i, m0, s0, m1, s1);
      hn::LoadInterleaved4(d, lower + 4 * i, m2, s2, m3, s3);
      const FloatVector du = hn::Load(d, corners.du + i);
      const FloatVector dv = hn::Load(d, corners.dv + i);
      const FloatVector mean = interpolated(interpolated(m0, m1, du), interpolated(m2, m3, du), dv);
      const FloatVector deviation =
          interpolated(interpolated(s0, s1, du), interpolated(s2, s3, du), dv);
      const FloatVector intensity = hn::LoadU(d, normalized + begin + i);
      const FloatVector value =
          hn::Div(hn::Sub(intensity, mean), hn::Add(deviation, all(contrast.constant)));
      const FloatMask in_view = visibleAt(visible, begin + i);
      const FloatMask is_kept = hn::And(in_view, hn::Lt(intensity, all(saturation)));
      hidden += hn::CountTrue(d, in_view) - hn::CountTrue(d, is_kept);
      hn::StoreU(hn::IfThenElseZero(is_kept, all(1.0F)), d, visible + begin + i);
      hn::StoreU(hn::IfThenElseZero(is_kept, value), d, normalized + begin + i);
    }
  }
  return hidden + reference::sampleNormalized(image, contrast, saturation, u + whole, v + whole,
                                              visible + whole, n - whole, normalized + whole);
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo
HWY_AFTER_NAMESPACE();
