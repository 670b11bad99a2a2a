// SPDX-License-Identifier: BSD-3-Clause
// Points of a keyframe, included by vector.cpp once for each instruction set.

HWY_BEFORE_NAMESPACE();
namespace mivo {
namespace kernels {
namespace HWY_NAMESPACE {

HWY_INLINE Number loadNumber(const float* values) {
  return {hn::LoadU(Floats(), values)};
}

template <bool kWithSecond>
HWY_INLINE void derivePart(const WarpParameters& camera, const PixelsView& pixels,
                           std::size_t begin, std::size_t end, const DerivedPoints& points,
                           double pixel_motion[21]) {
  const Floats d;
  FloatVector sums[21];
  for (FloatVector& sum : sums) sum = hn::Zero(d);
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    const Number v = loadNumber(pixels.v + i);
    const Ray ray = rayOf(camera, loadNumber(pixels.u + i), v);
    const Point3 X = pointOn(camera, ray, v, loadNumber(pixels.z + i));
    const PixelMotion motion = pixelMotion(X, ray.scale);
    const Number gu = loadNumber(pixels.gradient_u + i);
    const Number gv = loadNumber(pixels.gradient_v + i);
    hn::StoreU(X.x.v, d, points.x + i);
    hn::StoreU(X.y.v, d, points.y + i);
    hn::StoreU(X.z.v, d, points.z + i);
    int entry = 0;
    for (int row = 0; row < 6; ++row) {
      hn::StoreU((gu * motion.u[row] + gv * motion.v[row]).v, d, points.jacobian[row] + i);
      for (int column = row; column < 6; ++column, ++entry) {
        sums[entry] = hn::MulAdd(motion.u[row].v, motion.u[column].v, sums[entry]);
        sums[entry] = hn::MulAdd(motion.v[row].v, motion.v[column].v, sums[entry]);
      }
    }
    if (!kWithSecond) continue;
    Number second[21];
    const Curvature image = {loadNumber(pixels.curvature_uu + i),
                             loadNumber(pixels.curvature_uv + i),
                             loadNumber(pixels.curvature_vv + i)};
    secondDerivative(X, ray.scale, gu, gv, curvatureOnRay(camera, ray, gu, gv, image), second);
    for (int k = 0; k < 21; ++k) hn::StoreU(second[k].v, d, points.second_derivative[k] + i);
  }
  for (int k = 0; k < 21; ++k) pixel_motion[k] += total(sums[k]);
}

template <bool kWithSecond>
HWY_INLINE void derive(const WarpParameters& camera, const PixelsView& pixels, std::size_t n,
                       const DerivedPoints& points, double pixel_motion[21]) {
  for (std::size_t begin = 0; begin < n; begin += kSumLength) {
    derivePart<kWithSecond>(camera, pixels, begin, std::min(n, begin + kSumLength), points,
                            pixel_motion);
  }
}

inline void keyframePoints(const WarpParameters& camera, const PixelsView& pixels, std::size_t n,
                           const DerivedPoints& points, double pixel_motion[21]) {
  const std::size_t whole = wholeVectors(n);
  if (pixels.curvature_uu != nullptr) {
    derive<true>(camera, pixels, whole, points, pixel_motion);
  } else {
    derive<false>(camera, pixels, whole, points, pixel_motion);
  }
  reference::keyframePoints(camera, pixels.from(whole), n - whole, points.from(whole),
                            pixel_motion);
}

}  // namespace HWY_NAMESPACE
}  // namespace kernels
}  // namespace mivo
HWY_AFTER_NAMESPACE();
