// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/kernels/scalar.h"

namespace mivo {
namespace kernels {
namespace reference {
namespace {

struct Pixel2 {
  float u;
  float v;
  bool is_valid;
};

/// The factor of radial distortion.
float radialScale(const WarpParameters& p, float r2) {
  if (p.lens == Lens::kEquidistant) {
    const float r = std::sqrt(r2 + 1e-12F);
    const float angle = std::atan(r);
    const float a2 = angle * angle;
    return angle * (1.0F + a2 * (p.k1 + a2 * (p.k2 + a2 * (p.k3 + a2 * p.k4)))) / r;
  }
  const float over = 1.0F + r2 * (p.k1 + r2 * (p.k2 + r2 * p.k3));
  return p.lens == Lens::kRational ? over / (1.0F + r2 * (p.k4 + r2 * (p.k5 + r2 * p.k6))) : over;
}

Pixel2 projectPoint(const WarpParameters& p, const float (&q)[3]) {
  const float inverse = 1.0F / q[2];
  float x = q[0] * inverse;
  float y = q[1] * inverse;
  bool is_valid = q[2] > 0.0F;
  if (p.lens != Lens::kNone) {
    const float r2 = x * x + y * y;
    const float radial = radialScale(p, r2);
    const float xy2 = 2.0F * x * y;
    is_valid = is_valid && r2 <= p.max_squared_radius;
    const float distorted = x * radial + p.p1 * xy2 + p.p2 * (r2 + 2.0F * x * x);
    y = y * radial + p.p1 * (r2 + 2.0F * y * y) + p.p2 * xy2;
    x = distorted;
  }
  return {p.fx * x + p.cx, p.fy * y + p.cy, is_valid};
}

struct Corner {
  int column;
  int row;
  float du;
  float dv;
};

Corner cornerAt(float u, float v) {
  const int column = static_cast<int>(u);  // not negative, so truncating rounds down
  const int row = static_cast<int>(v);
  return {column, row, u - static_cast<float>(column), v - static_cast<float>(row)};
}

template <typename Value>
float bilinear(const Value* upper, const Value* lower, std::ptrdiff_t step, const Corner& corner) {
  const auto a = static_cast<float>(upper[0]);
  const auto b = static_cast<float>(lower[0]);
  const float top = a + corner.du * (static_cast<float>(upper[step]) - a);
  const float low = b + corner.du * (static_cast<float>(lower[step]) - b);
  return top + corner.dv * (low - top);
}

float intensityAt(const ImageView& image, float u, float v) {
  const Corner corner = cornerAt(u, v);
  const std::ptrdiff_t offset = corner.row * image.stride + corner.column;
  if (image.data != nullptr) {
    return bilinear(image.data + offset, image.data + offset + image.stride, 1, corner);
  }
  return bilinear(image.bytes + offset, image.bytes + offset + image.stride, 1, corner);
}

}  // namespace

std::size_t warpPoints(const WarpParameters& p, const PointsView& points, std::size_t n, float* u,
                       float* v, float* visible) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const float x = points.x[i];
    const float y = points.y[i];
    const float z = points.z[i];
    float q[3];
    for (int k = 0; k < 3; ++k) {
      const float* row = p.rotation + 3 * k;
      q[k] = row[0] * x + row[1] * y + row[2] * z + p.translation[k];
    }
    Pixel2 pixel = projectPoint(p, q);
    if (p.has_row_motion) {
      const float tau = pixel.v * p.row_duration + p.first_row;
      const float moved[3] = {
          q[0] + tau * (p.angular[1] * q[2] - p.angular[2] * q[1] + p.linear[0]),
          q[1] + tau * (p.angular[2] * q[0] - p.angular[0] * q[2] + p.linear[1]),
          q[2] + tau * (p.angular[0] * q[1] - p.angular[1] * q[0] + p.linear[2])};
      pixel = projectPoint(p, moved);
    }
    // Comparisons with NaN are false, so that NaN is outside.
    const bool is_visible = pixel.is_valid && pixel.u >= 0.0F && pixel.v >= 0.0F &&
                            pixel.u < p.right && pixel.v < p.bottom;
    u[i] = is_visible ? pixel.u : 0.0F;
    v[i] = is_visible ? pixel.v : 0.0F;
    visible[i] = is_visible ? 1.0F : 0.0F;
    if (is_visible) ++count;
  }
  return count;
}

void sampleIntensity(const ImageView& image, const float* u, const float* v, const float* visible,
                     std::size_t n, float* intensity) {
  for (std::size_t i = 0; i < n; ++i) {
    intensity[i] = visible[i] != 0.0F ? intensityAt(image, u[i], v[i]) : 0.0F;
  }
}

std::size_t sampleNormalized(const ImageView& image, const ContrastView& contrast, float saturation,
                             const float* u, const float* v, float* visible, std::size_t n,
                             float* normalized) {
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < n; ++i) {
    normalized[i] = 0.0F;
    if (visible[i] == 0.0F) continue;
    const float intensity = intensityAt(image, u[i], v[i]);
    if (intensity >= saturation) {
      visible[i] = 0.0F;
      ++hidden;
      continue;
    }
    const Corner corner = cornerAt(0.25F * u[i], 0.25F * v[i]);
    const float* upper = contrast.pairs + corner.row * contrast.stride + 2 * corner.column;
    const float* lower = upper + contrast.stride;
    const float mean = bilinear(upper, lower, 2, corner);
    const float deviation = bilinear(upper + 1, lower + 1, 2, corner);
    normalized[i] = (intensity - mean) / (deviation + contrast.constant);
  }
  return hidden;
}

}  // namespace reference
}  // namespace kernels
}  // namespace mivo
