// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/core/matx.hpp>
#include <opencv2/core/utility.hpp>

#include "core/execution/parallel_chunks.h"
#include "core/execution/recycled.h"
#include "core/terms/mi_term.h"

// Derivatives of MI = sum p_rl log(p_rl / (p_r p_l)) with respect to the increment d that warps the
// keyframe. Only the reference axis of the windows depends on d, p_l does not; with the position s
// of a point on the reference axis and its derivative J = ds/dd,
//
//   dp_rl = 1/n sum_x beta'_r beta_l J
//   G     = sum_rl log(p_rl / p_r) dp_rl
//
//   H     = sum_rl dp_rl dp_rl^T / p_rl - sum_r dp_r dp_r^T / p_r
//         + 1/n sum_x (h J J^T + g d2s)
//
// (log p_l and the constants drop out of G, for sum_r dp_rl = 0), where g = sum_rl beta'_r beta_l
// log(p_rl / p_r) and h the same with beta''_r over the 4 x 4 bins that a point touches. The first
// line of H alone is positive semidefinite: it is the second derivative of the windows, h, that
// makes H negative definite at the maximum.

namespace mivo {
namespace {

/// Contribution of one chunk of points.
struct Part {
  std::vector<cv::Vec<float, 16>> memory;
  float* rows = nullptr;  // in it: n dp_rl / s, kRowFloats for each pair of bins
  std::size_t size = 0;
  kernels::MiSums sums;

  /// All zero, aligned to a cache line: vectors that cross cache lines cost twice.
  void clear(std::size_t num_floats) {
    constexpr std::size_t kLine = 64;
    size = num_floats;
    memory.assign((num_floats * sizeof(float) + 2 * kLine - 1) / kLine, {});
    rows = cv::alignPtr(memory.front().val, static_cast<int>(kLine));
  }
};

Eigen::Map<const Eigen::Matrix<float, 6, 1>> rowOf(const Part& part, int index) {
  return Eigen::Map<const Eigen::Matrix<float, 6, 1>>(part.rows + index * kernels::kRowFloats);
}

/// Adds the other parts to the first one.
void addUp(std::vector<Part>& parts, std::size_t count) {
  Part& sum = parts[0];
  for (std::size_t p = 1; p < count; ++p) {
    for (std::size_t i = 0; i < sum.size; ++i) sum.rows[i] += parts[p].rows[i];
    for (int k = 0; k < 6; ++k) sum.sums.gradient[k] += parts[p].sums.gradient[k];
    for (int k = 0; k < kSymmetric6; ++k) sum.sums.curvature[k] += parts[p].sums.curvature[k];
  }
}

/// weight times v vᵀ, to the upper triangle.
void addSquare(const Vector6& v, double weight, Matrix6& sum) {
  for (int column = 0; column < 6; ++column) {
    const double factor = weight * v[column];
    for (int row = 0; row <= column; ++row) sum(row, column) += factor * v[row];
  }
}

/// sum_rl dp_rl dp_rlᵀ / p_rl - sum_r dp_r dp_rᵀ / p_r, upper triangle.
Matrix6 windowCurvature(const Part& part, const JointHistogram& histogram, double scale) {
  Matrix6 result = Matrix6::Zero();
  for (int r = 0; r < histogram.side(); ++r) {
    Vector6 marginal = Vector6::Zero();
    for (int l = 0; l < histogram.side(); ++l) {
      const double p = histogram.joint(r, l);
      if (!(p > 0.0)) continue;  // no pair touches these bins
      const Vector6 dp = scale * rowOf(part, r * histogram.side() + l).cast<double>();
      addSquare(dp, 1.0 / p, result);
      marginal += dp;
    }
    const double p = histogram.referenceMarginal(r);
    if (p > 0.0) addSquare(marginal, -1.0 / p, result);
  }
  return result;
}

}  // namespace

MiDerivatives mutualInformationDerivatives(const ReferencePoints& points,
                                           const MiReference& reference,
                                           const kernels::BinsView& live,
                                           const std::vector<float>& visible,
                                           std::size_t num_visible, const JointHistogram& histogram,
                                           int threads) {
  MiDerivatives result;
  if (num_visible == 0) return result;
  const std::size_t n = points.size();
  const auto cells = static_cast<std::size_t>(histogram.side() * histogram.side());
  const auto scale = static_cast<double>(reference.bins_per_gray_level);
  // A clamped intensity does not change under small motions.
  Recycled<std::vector<float>> active;
  active->resize(n);
  for (std::size_t i = 0; i < n; ++i) (*active)[i] = visible[i] * reference.unclamped[i];
  Recycled<std::vector<Part>> parts;
  if (parts->size() < numChunks(n)) parts->resize(numChunks(n));
  forEachChunk(n, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    const float* jacobian[6];
    const float* second_derivative[kSymmetric6];
    for (std::size_t k = 0; k < 6; ++k) jacobian[k] = points.jacobian[k].data() + begin;
    for (std::size_t k = 0; k < kSymmetric6; ++k) {
      second_derivative[k] = points.second_derivative[k].data() + begin;
    }
    Part& part = (*parts)[chunk];
    part.clear(cells * kernels::kRowFloats);
    kernels::active().miDerivatives(
        reference.bins(begin), {live.bin + begin, live.fraction + begin}, active->data() + begin,
        reference.jacobian_rows.data() + begin * kernels::kRowFloats, jacobian, second_derivative,
        end - begin, histogram.side(), reference.bins_per_gray_level, histogram.logRatios().data(),
        part.rows, part.sums);
  });
  addUp(*parts, numChunks(n));

  const Part& sum = parts->front();
  const double per_point = scale / static_cast<double>(num_visible);
  Matrix6 upper = windowCurvature(sum, histogram, per_point);
  const double* curvature = sum.sums.curvature;
  for (int row = 0; row < 6; ++row) {
    result.gradient[row] = per_point * sum.sums.gradient[row];
    for (int column = row; column < 6; ++column) upper(row, column) += per_point * *curvature++;
  }
  result.hessian = upper.selfadjointView<Eigen::Upper>();
  return result;
}

}  // namespace mivo
