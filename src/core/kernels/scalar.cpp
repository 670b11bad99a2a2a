// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/kernels/kernels.h"
#include "mivo/core/robust_weight.h"

// The readable reference of every kernel.

namespace mivo {
namespace kernels {
namespace {

struct Pixel2 {
  float u;
  float v;
  bool is_valid;
};

Pixel2 projectPoint(const WarpParameters& p, const float (&q)[3]) {
  const float inverse = 1.0F / q[2];
  float x = q[0] * inverse;
  float y = q[1] * inverse;
  bool is_valid = q[2] > 0.0F;
  if (p.is_distorted) {
    const float r2 = x * x + y * y;
    const float radial = 1.0F + r2 * (p.k1 + r2 * (p.k2 + r2 * p.k3));
    const float xy2 = 2.0F * x * y;
    is_valid = is_valid && r2 <= p.max_squared_radius;
    const float distorted = x * radial + p.p1 * xy2 + p.p2 * (r2 + 2.0F * x * x);
    y = y * radial + p.p1 * (r2 + 2.0F * y * y) + p.p2 * xy2;
    x = distorted;
  }
  return {p.fx * x + p.cx, p.fy * y + p.cy, is_valid};
}

float bilinear(const ImageView& image, float u, float v) {
  const int column = static_cast<int>(u);  // never negative: truncation is the floor
  const int row = static_cast<int>(v);
  const float du = u - static_cast<float>(column);
  const float dv = v - static_cast<float>(row);
  const float* upper = image.data + row * image.stride + column;
  const float* lower = upper + image.stride;
  const float top = upper[0] + du * (upper[1] - upper[0]);
  const float low = lower[0] + du * (lower[1] - lower[0]);
  return top + dv * (low - top);
}

/// The same, with coordinates beyond the last pixel drawn back to it.
float bilinearClamped(const ImageView& image, float u, float v) {
  const auto limit = [](float value, int size) {
    const float last = static_cast<float>(size - 1) * 0.999999F;
    return value < last ? value : last;
  };
  return bilinear(image, limit(u, image.width), limit(v, image.height));
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
      const float tau = pixel.v / p.height - 0.5F;
      const float moved[3] = {
          q[0] + tau * (p.angular[1] * q[2] - p.angular[2] * q[1] + p.linear[0]),
          q[1] + tau * (p.angular[2] * q[0] - p.angular[0] * q[2] + p.linear[1]),
          q[2] + tau * (p.angular[0] * q[1] - p.angular[1] * q[0] + p.linear[2])};
      pixel = projectPoint(p, moved);
    }
    // Written so that NaN is outside.
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
    intensity[i] = visible[i] != 0.0F ? bilinear(image, u[i], v[i]) : 0.0F;
  }
}

void sampleNormalised(const ImageView& image, const ImageView& mean, const ImageView& deviation,
                      float constant, const float* u, const float* v, const float* visible,
                      std::size_t n, float* normalised) {
  for (std::size_t i = 0; i < n; ++i) {
    if (visible[i] == 0.0F) {
      normalised[i] = 0.0F;
      continue;
    }
    const float mu = 0.25F * u[i];
    const float mv = 0.25F * v[i];
    normalised[i] = (bilinear(image, u[i], v[i]) - bilinearClamped(mean, mu, mv)) /
                    (bilinearClamped(deviation, mu, mv) + constant);
  }
}

void residuals(const float* live, const float* contrast, const float* reference,
               const float* visible, std::size_t n, float* residual) {
  for (std::size_t i = 0; i < n; ++i) {
    residual[i] = visible[i] != 0.0F ? contrast[i] * live[i] - reference[i] : 0.0F;
  }
}

double robustCost(RobustWeight kind, float scale, const float* residual, const float* visible,
                  std::size_t n) {
  const float inverse_scale = 1.0F / scale;
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (visible[i] == 0.0F) continue;
    sum += static_cast<double>(robustLoss(kind, residual[i] * inverse_scale).loss);
  }
  return sum;
}

void accumulateLeastSquares(RobustWeight kind, float scale, const float* residual,
                            const float* visible, const float* const jacobian[6], std::size_t n,
                            LeastSquaresSums& sums) {
  sums = LeastSquaresSums{};
  const float inverse_scale = 1.0F / scale;
  for (std::size_t i = 0; i < n; ++i) {
    if (visible[i] == 0.0F) continue;
    const float weight = robustLoss(kind, residual[i] * inverse_scale).weight;
    double* entry = sums.hessian;
    for (int row = 0; row < 6; ++row) {
      const float weighted = weight * jacobian[row][i];
      sums.gradient[row] += static_cast<double>(weighted * residual[i]);
      for (int column = row; column < 6; ++column) {
        *entry++ += static_cast<double>(weighted * jacobian[column][i]);
      }
    }
  }
}

}  // namespace kernels
}  // namespace mivo
