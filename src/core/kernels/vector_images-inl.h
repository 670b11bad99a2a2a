// SPDX-License-Identifier: BSD-3-Clause
// Whole images, included by vector.cpp once for each instruction set.

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {

constexpr int kWindowRadius = 2;

HWY_INLINE int mirroredIndex(int i, int n) {
  if (n == 1) return 0;
  while (i < 0 || i >= n) i = i < 0 ? -i : 2 * (n - 1) - i;
  return i;
}

/// Fills the two entries before and after a row of n by mirroring.
template <typename Value>
HWY_INLINE void mirrorEnds(Value* row, int n) {
  for (int k = 1; k <= kWindowRadius; ++k) {
    row[-k] = row[mirroredIndex(-k, n)];
    row[n - 1 + k] = row[mirroredIndex(n - 1 + k, n)];
  }
}

/// The five rows around row y, mirrored at the border.
template <typename Value>
struct FiveRows {
  const Value* row[5];
};

template <typename Value>
HWY_INLINE FiveRows<Value> rowsAround(const Value* data, std::ptrdiff_t stride, int y, int height) {
  FiveRows<Value> rows;
  for (int k = 0; k < 5; ++k) {
    rows.row[k] = data + mirroredIndex(y + k - kWindowRadius, height) * stride;
  }
  return rows;
}

template <class V>
HWY_INLINE V gaussian(V a, V b, V c, V e, V f, V four, V six) {
  return hn::Add(hn::Add(a, f), hn::Add(hn::Mul(six, c), hn::Mul(four, hn::Add(b, e))));
}

/// Vertical pass of the Gaussian, (1, 4, 6, 4, 1): bytes give exact 16-bit sums.
HWY_INLINE void gaussianDown(const FiveRows<unsigned char>& rows, int width, std::uint16_t* sums) {
  const hn::ScalableTag<std::uint16_t> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const auto four = hn::Set(d, 4);
  const auto six = hn::Set(d, 6);
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    hn::StoreU(gaussian(hn::PromoteTo(d, hn::LoadU(d8, rows.row[0] + x)),
                        hn::PromoteTo(d, hn::LoadU(d8, rows.row[1] + x)),
                        hn::PromoteTo(d, hn::LoadU(d8, rows.row[2] + x)),
                        hn::PromoteTo(d, hn::LoadU(d8, rows.row[3] + x)),
                        hn::PromoteTo(d, hn::LoadU(d8, rows.row[4] + x)), four, six),
               d, sums + x);
  }
  for (; x < width; ++x) {
    const int outer = rows.row[0][x] + rows.row[4][x];
    const int inner = rows.row[1][x] + rows.row[3][x];
    sums[x] = static_cast<std::uint16_t>(outer + 4 * inner + 6 * rows.row[2][x]);
  }
}

HWY_INLINE void gaussianDown(const FiveRows<float>& rows, int width, float* sums) {
  const Floats d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    hn::StoreU(gaussian(hn::LoadU(d, rows.row[0] + x), hn::LoadU(d, rows.row[1] + x),
                        hn::LoadU(d, rows.row[2] + x), hn::LoadU(d, rows.row[3] + x),
                        hn::LoadU(d, rows.row[4] + x), all(4.0F), all(6.0F)),
               d, sums + x);
  }
  for (; x < width; ++x) {
    sums[x] = rows.row[0][x] + rows.row[4][x] + 4.0F * (rows.row[1][x] + rows.row[3][x]) +
              6.0F * rows.row[2][x];
  }
}

/// Horizontal pass, at every second entry. The row has two more entries at each end.
HWY_INLINE void gaussianAlong(const std::uint16_t* sums, int coarse_width, float* coarse) {
  const hn::ScalableTag<std::uint16_t> d;
  const hn::Half<decltype(d)> half;
  const hn::Rebind<std::int32_t, decltype(half)> wide;
  const hn::Rebind<float, decltype(half)> floats;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const auto norm = hn::Set(floats, 1.0F / 256.0F);
  int x = 0;
  for (; x + lanes <= coarse_width; x += lanes) {
    hn::Vec<decltype(d)> a, b, c, e, f, unused;
    hn::LoadInterleaved2(d, sums + 2 * x - 2, a, b);
    hn::LoadInterleaved2(d, sums + 2 * x, c, e);
    hn::LoadInterleaved2(d, sums + 2 * x + 2, f, unused);
    const auto sum = gaussian(a, b, c, e, f, hn::Set(d, 4), hn::Set(d, 6));
    const auto low = hn::ConvertTo(floats, hn::PromoteTo(wide, hn::LowerHalf(half, sum)));
    const auto high = hn::ConvertTo(floats, hn::PromoteTo(wide, hn::UpperHalf(half, sum)));
    hn::StoreU(hn::Mul(norm, low), floats, coarse + x);
    hn::StoreU(hn::Mul(norm, high), floats, coarse + x + lanes / 2);
  }
  for (; x < coarse_width; ++x) {
    const std::uint16_t* s = sums + 2 * x;
    const int sum = s[-2] + s[2] + 4 * (s[-1] + s[1]) + 6 * s[0];
    coarse[x] = static_cast<float>(sum) * (1.0F / 256.0F);
  }
}

HWY_INLINE void gaussianAlong(const float* sums, int coarse_width, float* coarse) {
  const Floats d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  int x = 0;
  for (; x + lanes <= coarse_width; x += lanes) {
    FloatVector a, b, c, e, f, unused;
    hn::LoadInterleaved2(d, sums + 2 * x - 2, a, b);
    hn::LoadInterleaved2(d, sums + 2 * x, c, e);
    hn::LoadInterleaved2(d, sums + 2 * x + 2, f, unused);
    const FloatVector sum = gaussian(a, b, c, e, f, all(4.0F), all(6.0F));
    hn::StoreU(hn::Mul(all(1.0F / 256.0F), sum), d, coarse + x);
  }
  for (; x < coarse_width; ++x) {
    const float* s = sums + 2 * x;
    coarse[x] = (s[-2] + s[2] + 4.0F * (s[-1] + s[1]) + 6.0F * s[0]) * (1.0F / 256.0F);
  }
}

template <typename Value, typename Sum>
HWY_INLINE void reduceRows(const Value* data, const ImageView& fine, float* coarse,
                           std::ptrdiff_t coarse_stride, Sum* sums) {
  const int coarse_width = (fine.width + 1) / 2;
  for (int y = 0; 2 * y < fine.height; ++y) {
    gaussianDown(rowsAround(data, fine.stride, 2 * y, fine.height), fine.width, sums);
    mirrorEnds(sums, fine.width);
    gaussianAlong(sums, coarse_width, coarse + y * coarse_stride);
  }
}

inline void reduce(const ImageView& fine, float* coarse, std::ptrdiff_t coarse_stride,
                   float* scratch) {
  // The last vectors read up to four entries beyond the mirrored ones.
  if (fine.data != nullptr) {
    reduceRows(fine.data, fine, coarse, coarse_stride, scratch + 16);
  } else {
    reduceRows(fine.bytes, fine, coarse, coarse_stride,
               reinterpret_cast<std::uint16_t*>(scratch + 16));
  }
}

/// Vertical pass of the binomial, (1, 2, 1), and the maximum of the three bytes.
HWY_INLINE void binomialDown(const std::uint8_t* const rows[3], int width, std::uint16_t* sums,
                             std::uint8_t* maxima) {
  const hn::ScalableTag<std::uint16_t> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto above = hn::LoadU(d8, rows[0] + x);
    const auto here = hn::LoadU(d8, rows[1] + x);
    const auto below = hn::LoadU(d8, rows[2] + x);
    const auto middle = hn::PromoteTo(d, here);
    const auto outer = hn::Add(hn::PromoteTo(d, above), hn::PromoteTo(d, below));
    hn::StoreU(hn::Add(outer, hn::Add(middle, middle)), d, sums + x);
    hn::StoreU(hn::Max(here, hn::Max(above, below)), d8, maxima + x);
  }
  for (; x < width; ++x) {
    sums[x] = static_cast<std::uint16_t>(rows[0][x] + 2 * rows[1][x] + rows[2][x]);
    maxima[x] = std::max(rows[1][x], std::max(rows[0][x], rows[2][x]));
  }
}

/// Horizontal pass, over a row with one more entry at each end. @param row the image's.
HWY_INLINE void binomialAlong(const std::uint16_t* sums, const std::uint8_t* maxima,
                              const std::uint8_t* row, int width, std::uint8_t largest,
                              std::uint8_t* smoothed) {
  const hn::ScalableTag<std::uint16_t> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const hn::RebindToSigned<decltype(d)> d_signed;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const auto highest = hn::Set(d8, largest);
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto outer = hn::Add(hn::LoadU(d, sums + x - 1), hn::LoadU(d, sums + x + 1));
    const auto middle = hn::LoadU(d, sums + x);
    const auto sum = hn::Add(hn::Add(outer, hn::Add(middle, middle)), hn::Set(d, 8));
    const auto value = hn::DemoteTo(d8, hn::BitCast(d_signed, hn::ShiftRight<4>(sum)));
    const auto maximum = hn::Max(hn::LoadU(d8, maxima + x), hn::Max(hn::LoadU(d8, maxima + x - 1),
                                                                    hn::LoadU(d8, maxima + x + 1)));
    const auto is_valid = hn::Eq(hn::Max(maximum, highest), highest);
    hn::StoreU(hn::IfThenElse(is_valid, value, hn::LoadU(d8, row + x)), d8, smoothed + x);
  }
  for (; x < width; ++x) {
    const int sum = sums[x - 1] + 2 * sums[x] + sums[x + 1] + 8;
    const bool is_valid = std::max(maxima[x], std::max(maxima[x - 1], maxima[x + 1])) <= largest;
    smoothed[x] = is_valid ? static_cast<std::uint8_t>(sum / 16) : row[x];
  }
}

inline void smooth(const ImageView& image, std::uint8_t largest, std::uint8_t* smoothed,
                   std::ptrdiff_t smoothed_stride, float* scratch) {
  std::uint16_t* sums = reinterpret_cast<std::uint16_t*>(scratch) + 16;
  std::uint8_t* maxima = reinterpret_cast<std::uint8_t*>(sums + image.width + 64);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* rows[3];
    for (int k = 0; k < 3; ++k) {
      rows[k] = image.bytes + mirroredIndex(y + k - 1, image.height) * image.stride;
    }
    binomialDown(rows, image.width, sums, maxima);
    mirrorEnds(sums, image.width);
    mirrorEnds(maxima, image.width);
    binomialAlong(sums, maxima, rows[1], image.width, largest, smoothed + y * smoothed_stride);
  }
}

/// Vertical sums of five values and of their squares.
HWY_INLINE void momentsDown(const FiveRows<float>& rows, int width, float* sums, float* squares) {
  const Floats d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    FloatVector sum = hn::Zero(d);
    FloatVector square = hn::Zero(d);
    for (const float* row : rows.row) {
      const FloatVector value = hn::LoadU(d, row + x);
      sum = hn::Add(sum, value);
      square = hn::MulAdd(value, value, square);
    }
    hn::StoreU(sum, d, sums + x);
    hn::StoreU(square, d, squares + x);
  }
  for (; x < width; ++x) {
    sums[x] = 0.0F;
    squares[x] = 0.0F;
    for (const float* row : rows.row) {
      sums[x] += row[x];
      squares[x] += row[x] * row[x];
    }
  }
}

HWY_INLINE FloatVector fiveAlong(const float* sums) {
  const Floats d;
  const FloatVector outer = hn::Add(hn::LoadU(d, sums - 2), hn::LoadU(d, sums + 2));
  const FloatVector inner = hn::Add(hn::LoadU(d, sums - 1), hn::LoadU(d, sums + 1));
  return hn::Add(hn::Add(outer, inner), hn::LoadU(d, sums));
}

inline double contrastMap(const ImageView& image, float* pairs, std::ptrdiff_t pairs_stride,
                          float* scratch) {
  constexpr float kInverseArea = 1.0F / 25.0F;
  const Floats d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  float* sums = scratch + 16;
  float* squares = sums + image.width + 64;
  double variances = 0.0;
  for (int y = 0; y < image.height; ++y) {
    momentsDown(rowsAround(image.data, image.stride, y, image.height), image.width, sums, squares);
    mirrorEnds(sums, image.width);
    mirrorEnds(squares, image.width);
    float* row = pairs + y * pairs_stride;
    FloatVector part = hn::Zero(d);
    int x = 0;
    for (; x + lanes <= image.width; x += lanes) {
      const FloatVector mean = hn::Mul(all(kInverseArea), fiveAlong(sums + x));
      const FloatVector square = hn::Mul(all(kInverseArea), fiveAlong(squares + x));
      const FloatVector variance = hn::Max(all(0.0F), hn::NegMulAdd(mean, mean, square));
      part = hn::Add(part, variance);
      hn::StoreInterleaved2(mean, hn::Sqrt(variance), d, row + 2 * x);
    }
    variances += total(part);
    for (; x < image.width; ++x) {
      const float* s = sums + x;
      const float* q = squares + x;
      const float mean = kInverseArea * (s[-2] + s[-1] + s[0] + s[1] + s[2]);
      const float square = kInverseArea * (q[-2] + q[-1] + q[0] + q[1] + q[2]);
      const float variance = std::max(0.0F, square - mean * mean);
      variances += static_cast<double>(variance);
      row[2 * x] = mean;
      row[2 * x + 1] = std::sqrt(variance);
    }
  }
  return variances;
}

/// Interpolates the contrast map vertically at the image's row y: mean and deviation of each map
/// pixel and of the one right of the last. Reads and writes whole vectors.
HWY_INLINE void mapDown(const ContrastView& contrast, int y, int map_width, float* means,
                        float* deviations) {
  const Floats d;
  const float* upper = contrast.pairs + y / 4 * contrast.stride;
  const float* lower = upper + contrast.stride;
  const float t = 0.25F * static_cast<float>(y % 4);
  const auto lanes = static_cast<int>(hn::Lanes(d));
  int x = 0;
  for (; x + lanes <= map_width; x += lanes) {
    FloatVector m0, s0, m1, s1;
    hn::LoadInterleaved2(d, upper + 2 * x, m0, s0);
    hn::LoadInterleaved2(d, lower + 2 * x, m1, s1);
    hn::StoreU(interpolated(m0, m1, all(t)), d, means + x);
    hn::StoreU(interpolated(s0, s1, all(t)), d, deviations + x);
  }
  for (; x < map_width; ++x) {
    means[x] = upper[2 * x] + t * (lower[2 * x] - upper[2 * x]);
    deviations[x] = upper[2 * x + 1] + t * (lower[2 * x + 1] - upper[2 * x + 1]);
  }
}

/// Interpolates horizontally: four values per entry of the map, at 0, 1/4, 1/2 and 3/4 of the
/// distance to the next entry.
HWY_INLINE void quartersAt(const float* map, float* places) {
  const Floats d;
  const FloatVector here = hn::LoadU(d, map);
  const FloatVector way = hn::Sub(hn::LoadU(d, map + 1), here);
  hn::StoreInterleaved4(here, hn::MulAdd(all(0.25F), way, here), hn::MulAdd(all(0.5F), way, here),
                        hn::MulAdd(all(0.75F), way, here), d, places);
}

HWY_INLINE FloatVector intensities(const ImageView& image, std::ptrdiff_t offset) {
  const Floats d;
  if (image.data != nullptr) return hn::LoadU(d, image.data + offset);
  const hn::Rebind<std::uint8_t, Floats> d8;
  return hn::ConvertTo(d, hn::PromoteTo(Integers(), hn::LoadU(d8, image.bytes + offset)));
}

inline void normalizeImage(const ImageView& image, const ContrastView& contrast,
                           const NormalizeParameters& p, float* normalized,
                           std::ptrdiff_t normalized_stride, float* scratch) {
  const Floats d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const int map_width = (image.width + 3) / 4 + 1;
  const int whole = image.width - image.width % (4 * lanes);
  float* means = scratch;
  float* deviations = scratch + image.width + 64;
  alignas(64) float mean[4 * HWY_MAX_BYTES / sizeof(float)];
  alignas(64) float deviation[4 * HWY_MAX_BYTES / sizeof(float)];
  for (int y = 0; y < image.height; ++y) {
    mapDown(contrast, y, map_width, means, deviations);
    const std::ptrdiff_t row = y * image.stride;
    float* out = normalized + y * normalized_stride;
    for (int x = 0; x < whole; x += 4 * lanes) {
      quartersAt(means + x / 4, mean);
      quartersAt(deviations + x / 4, deviation);
      for (int k = 0; k < 4 * lanes; k += lanes) {
        const FloatVector difference =
            hn::Sub(intensities(image, row + x + k), hn::Load(d, mean + k));
        const FloatVector value =
            hn::Div(difference, hn::Add(hn::Load(d, deviation + k), all(p.constant)));
        const FloatVector gray = hn::MulAdd(all(p.gain), value, all(p.middle));
        hn::StoreU(hn::Min(hn::Max(gray, all(0.0F)), all(p.white)), d, out + x + k);
      }
    }
    for (int x = whole; x < image.width; ++x) {
      const float t = 0.25F * static_cast<float>(x % 4);
      const int m = x / 4;
      const float local_mean = means[m] + t * (means[m + 1] - means[m]);
      const float local = deviations[m] + t * (deviations[m + 1] - deviations[m]);
      const float intensity =
          image.data != nullptr ? image.data[row + x] : static_cast<float>(image.bytes[row + x]);
      const float gray = p.middle + p.gain * ((intensity - local_mean) / (local + p.constant));
      out[x] = std::min(std::max(gray, 0.0F), p.white);
    }
  }
}

/// Calls body(x) for the vectors that cover first <= x < end. The last vector overlaps the previous
/// one if the length is no multiple of a vector's. Returns the first x not covered: `end`, or
/// `first` if the range is shorter than a vector.
template <typename Body>
HWY_INLINE int forWholeVectors(int first, int end, const Body& body) {
  const auto lanes = static_cast<int>(hn::Lanes(Floats()));
  if (end - first < lanes) return first;
  int x = first;
  for (; x + lanes <= end; x += lanes) body(x);
  if (x < end) body(end - lanes);
  return end;
}

inline void gradientRow(const ImageView& image, int y, float* squared) {
  const Floats d;
  const std::ptrdiff_t row = y * image.stride;
  squared[0] = 0.0F;
  squared[image.width - 1] = 0.0F;
  const auto square = [&](int x) HWY_ATTR {
    const FloatVector gx =
        hn::Sub(intensities(image, row + x + 1), intensities(image, row + x - 1));
    const FloatVector gy = hn::Sub(intensities(image, row + x + image.stride),
                                   intensities(image, row + x - image.stride));
    hn::StoreU(hn::Mul(all(0.25F), hn::MulAdd(gx, gx, hn::Mul(gy, gy))), d, squared + x);
  };
  reference::gradientTail(image, y, forWholeVectors(1, image.width - 1, square), squared);
}

inline void maximaRow(const ImageView& image, int y, const float* const squared[3], float threshold,
                      std::uint8_t* maximal) {
  constexpr float kTan22_5 = 0.41421356F;
  const Floats d;
  const hn::Rebind<std::uint8_t, Floats> d8;
  const std::ptrdiff_t row = y * image.stride;
  for (int x = 0; x < 2 && x < image.width; ++x) maximal[x] = 0;
  const auto mark = [&](int x) HWY_ATTR {
    const FloatVector here = hn::LoadU(d, squared[1] + x);
    const FloatMask is_strong = hn::And(hn::Gt(here, all(0.0F)), hn::Ge(here, all(threshold)));
    const FloatVector gx =
        hn::Sub(intensities(image, row + x + 1), intensities(image, row + x - 1));
    const FloatVector gy = hn::Sub(intensities(image, row + x + image.stride),
                                   intensities(image, row + x - image.stride));
    const FloatVector ax = hn::Abs(gx);
    const FloatVector ay = hn::Abs(gy);
    const FloatMask is_along = hn::Le(ay, hn::Mul(ax, all(kTan22_5)));
    const FloatMask is_down = hn::Le(ax, hn::Mul(ay, all(kTan22_5)));
    const FloatMask is_falling = hn::Ge(hn::Mul(gx, gy), all(0.0F));
    const FloatVector before =
        hn::IfThenElse(is_along, hn::LoadU(d, squared[1] + x - 1),
                       hn::IfThenElse(is_down, hn::LoadU(d, squared[0] + x),
                                      hn::IfThenElse(is_falling, hn::LoadU(d, squared[0] + x - 1),
                                                     hn::LoadU(d, squared[0] + x + 1))));
    const FloatVector after =
        hn::IfThenElse(is_along, hn::LoadU(d, squared[1] + x + 1),
                       hn::IfThenElse(is_down, hn::LoadU(d, squared[2] + x),
                                      hn::IfThenElse(is_falling, hn::LoadU(d, squared[2] + x + 1),
                                                     hn::LoadU(d, squared[2] + x - 1))));
    const FloatMask is_maximal =
        hn::And(is_strong, hn::And(hn::Ge(here, before), hn::Gt(here, after)));
    const auto one =
        hn::IfThenElseZero(hn::RebindMask(Integers(), is_maximal), hn::Set(Integers(), 1));
    hn::StoreU(hn::DemoteTo(d8, one), d8, maximal + x);
  };
  const int rest = forWholeVectors(2, image.width - 2, mark);
  reference::maximaTail(image, y, squared, threshold, rest, maximal);
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo
HWY_AFTER_NAMESPACE();
