// SPDX-License-Identifier: BSD-3-Clause
#include "core/kernels/scalar.h"
#include "core/kernels/scalar_formulas.h"
#include "core/terms/robust_weight.h"

namespace mivo {
namespace kernels {
namespace reference {
namespace {

float readingAt(const DepthView& depth, std::ptrdiff_t offset) {
  const float z = depth.meters != nullptr ? depth.meters[offset]
                                          : static_cast<float>(depth.steps[offset]) * depth.unit;
  return z > 0.0F && z < kMaxReading ? z : 0.0F;  // NaN is no reading, too
}

}  // namespace

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

void robustWeights(RobustWeight kind, float scale, const float* residual, const float* visible,
                   std::size_t n, float* weight) {
  const float inverse_scale = 1.0F / scale;
  for (std::size_t i = 0; i < n; ++i) {
    weight[i] = visible[i] != 0.0F ? robustLoss(kind, residual[i] * inverse_scale).weight : 0.0F;
  }
}

void accumulateLeastSquares(RobustWeight kind, float scale, const float* residual,
                            const float* visible, const float* const jacobian[6], std::size_t n,
                            LeastSquaresSums& sums) {
  sums = LeastSquaresSums{};
  const float inverse_scale = 1.0F / scale;
  for (std::size_t i = 0; i < n; ++i) {
    if (visible[i] == 0.0F) continue;
    const RobustLoss robust = robustLoss(kind, residual[i] * inverse_scale);
    sums.weight += static_cast<double>(robust.weight);
    sums.curvature += static_cast<double>(robust.curvature);
    double* entry = sums.hessian;
    for (int row = 0; row < 6; ++row) {
      const float weighted = robust.weight * jacobian[row][i];
      sums.gradient[row] += static_cast<double>(weighted * residual[i]);
      for (int column = row; column < 6; ++column) {
        *entry++ += static_cast<double>(weighted * jacobian[column][i]);
      }
    }
  }
}

void accumulateScores(RobustWeight kind, float scale, const float* residual, const float* visible,
                      const float* const jacobian[6], const float* u, const float* v, std::size_t n,
                      const BlockGrid& grid, BlockScore* blocks) {
  const float inverse_scale = 1.0F / scale;
  for (std::size_t i = 0; i < n; ++i) {
    if (visible[i] == 0.0F) continue;
    const int column = static_cast<int>(u[i] * grid.per_pixel);
    const int row = static_cast<int>(v[i] * grid.per_pixel);
    float* score = blocks[row * grid.columns + column].score;
    const float influence = robustLoss(kind, residual[i] * inverse_scale).weight * residual[i];
    for (int k = 0; k < 6; ++k) score[k] += influence * jacobian[k][i];
    score[6] += 1.0F;
  }
}

void sumPairs(const float* a, const float* b, const float* divisor, const float* visible,
              std::size_t n, PairSums& sums) {
  sums = PairSums{};
  for (std::size_t i = 0; i < n; ++i) {
    if (visible[i] == 0.0F) continue;
    const auto first = static_cast<double>(a[i]);
    const auto second = static_cast<double>(b[i] / divisor[i]);
    sums.a += first;
    sums.b += second;
    sums.aa += first * first;
    sums.bb += second * second;
    sums.ab += first * second;
  }
}

std::size_t geometricResiduals(const WarpParameters& live, const Motion& T_ref_live,
                               const PlanesView& planes, const DepthView& depth, const float* u,
                               const float* v, std::size_t n, float* visible, float* residual,
                               float* const jacobian[6]) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const float is_in_view = visible[i];
    visible[i] = 0.0F;
    residual[i] = 0.0F;
    for (int k = 0; k < 6; ++k) jacobian[k][i] = 0.0F;
    if (is_in_view == 0.0F) continue;
    const int column = static_cast<int>(u[i] + 0.5F);
    const int row = static_cast<int>(v[i] + 0.5F);
    const float z = readingAt(depth, row * depth.stride + column);
    if (z <= 0.0F) continue;
    const float X[3] = {planes.point.x[i], planes.point.y[i], planes.point.z[i]};
    const float N[3] = {planes.normal.x[i], planes.normal.y[i], planes.normal.z[i]};
    float q[3];
    for (int k = 0; k < 3; ++k) {
      const float* R = live.rotation + 3 * k;
      q[k] = R[0] * X[0] + R[1] * X[1] + R[2] * X[2] + live.translation[k];
    }
    float shift[3] = {0.0F, 0.0F, 0.0F};
    if (live.has_row_motion) {
      const float tau = v[i] * live.row_duration + live.first_row;
      const float* w = live.angular;
      shift[0] = tau * (w[1] * q[2] - w[2] * q[1] + live.linear[0]);
      shift[1] = tau * (w[2] * q[0] - w[0] * q[2] + live.linear[1]);
      shift[2] = tau * (w[0] * q[1] - w[1] * q[0] + live.linear[2]);
    }
    const float inverse = 1.0F / (q[2] + shift[2]);
    const NormalizedPoint ray = {(q[0] + shift[0]) * inverse, (q[1] + shift[1]) * inverse};
    const NormalizedPoint step = beforeLens(live, ray,
                                            {(static_cast<float>(column) - u[i]) / live.fx,
                                             (static_cast<float>(row) - v[i]) / live.fy});
    const float Y[3] = {z * (ray.x + step.x) - shift[0], z * (ray.y + step.y) - shift[1],
                        z - shift[2]};
    float P[3];
    for (int k = 0; k < 3; ++k) {
      const float* R = T_ref_live.rotation + 3 * k;
      P[k] = R[0] * Y[0] + R[1] * Y[1] + R[2] * Y[2] + T_ref_live.translation[k];
    }
    const float weight = planes.weight[i];
    residual[i] = weight * (N[0] * (P[0] - X[0]) + N[1] * (P[1] - X[1]) + N[2] * (P[2] - X[2]));
    visible[i] = 1.0F;
    ++count;
    // The increment moves P to exp(w) P + v, which adds n . v + (P x n) . w to r.
    jacobian[0][i] = -weight * N[0];
    jacobian[1][i] = -weight * N[1];
    jacobian[2][i] = -weight * N[2];
    jacobian[3][i] = -weight * (P[1] * N[2] - P[2] * N[1]);
    jacobian[4][i] = -weight * (P[2] * N[0] - P[0] * N[2]);
    jacobian[5][i] = -weight * (P[0] * N[1] - P[1] * N[0]);
  }
  return count;
}

}  // namespace reference
}  // namespace kernels
}  // namespace mivo
