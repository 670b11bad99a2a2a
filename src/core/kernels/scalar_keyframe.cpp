// SPDX-License-Identifier: BSD-3-Clause
#include "core/kernels/scalar.h"
#include "core/kernels/scalar_formulas.h"

namespace mivo {
namespace kernels {
namespace reference {

void keyframePoints(const WarpParameters& camera, const PixelsView& pixels, std::size_t n,
                    const DerivedPoints& points, double pixel_motion[21]) {
  for (std::size_t i = 0; i < n; ++i) {
    const Ray ray = rayOf(camera, pixels.u[i], pixels.v[i]);
    const Point3 X = pointOn(camera, ray, pixels.v[i], pixels.z[i]);
    const PixelMotion motion = pixelMotion(X, ray.scale);
    const float gu = pixels.gradient_u[i];
    const float gv = pixels.gradient_v[i];
    points.x[i] = X.x;
    points.y[i] = X.y;
    points.z[i] = X.z;
    int entry = 0;
    for (int row = 0; row < 6; ++row) {
      points.jacobian[row][i] = gu * motion.u[row] + gv * motion.v[row];
      for (int column = row; column < 6; ++column, ++entry) {
        pixel_motion[entry] += static_cast<double>(motion.u[row] * motion.u[column] +
                                                   motion.v[row] * motion.v[column]);
      }
    }
    if (pixels.curvature_uu == nullptr) continue;
    float second[21];
    const Curvature image = {pixels.curvature_uu[i], pixels.curvature_uv[i],
                             pixels.curvature_vv[i]};
    secondDerivative(X, ray.scale, gu, gv, curvatureOnRay(camera, ray, gu, gv, image), second);
    for (int k = 0; k < 21; ++k) points.second_derivative[k][i] = second[k];
  }
}

}  // namespace reference
}  // namespace kernels
}  // namespace mivo
