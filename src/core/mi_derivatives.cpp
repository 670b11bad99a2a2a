// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "mivo/core/mi_term.h"
#include "mivo/core/parallel_chunks.h"

// Derivatives of MI = sum p_rl log(p_rl / (p_r p_l)) with respect to the increment d that warps the
// keyframe. Only the reference axis of the windows depends on d, p_l does not; with the position s
// of a point on the reference axis and its derivative J = ds/dd,
//
//   dp_rl = 1/n sum_x beta'_r beta_l J
//   G     = sum_rl log(p_rl / p_r) dp_rl        (log p_l and the constants drop out: sum_r dp_rl =
//   0) H     = sum_rl dp_rl dp_rl^T / p_rl - sum_r dp_r dp_r^T / p_r
//         + 1/n sum_x (h J J^T + g d2s)
//
// where g = sum_rl beta'_r beta_l log(p_rl / p_r) and h the same with beta''_r over the 4 x 4 bins
// that a point touches. The first line of H alone is positive semidefinite: it is the second
// derivative of the windows, h, that makes H negative definite at the maximum.

namespace mivo {
namespace {

struct Sums {
  explicit Sums(std::size_t cells) : joint_derivative(cells, Vector6::Zero()) {}
  std::vector<Vector6> joint_derivative;  // n dp_rl
  Vector6 gradient = Vector6::Zero();
  Matrix6 curvature = Matrix6::Zero();  // sum of h J J^T + g d2s, upper triangle
};

std::vector<double> logRatios(const JointHistogram& histogram) {
  const int side = histogram.side();
  std::vector<double> result(static_cast<std::size_t>(side * side));
  for (int r = 0; r < side; ++r) {
    for (int l = 0; l < side; ++l) {
      const double p = histogram.joint(r, l);
      if (p > 0.0) {
        result[static_cast<std::size_t>(r * side + l)] =
            std::log(p / histogram.referenceMarginal(r));
      }
    }
  }
  return result;
}

void addPoint(const ReferencePoints& points, const BinPosition& reference, const BinPosition& live,
              float bins_per_grey_level, const std::vector<double>& log_ratio, int side,
              std::size_t i, Sums& sums) {
  const SplineWeights first = splineDerivatives(reference.fraction);
  const SplineWeights second = splineSecondDerivatives(reference.fraction);
  const SplineWeights weights = splineWeights(live.fraction);
  Vector6 J;
  for (std::size_t k = 0; k < 6; ++k) {
    J[static_cast<int>(k)] = static_cast<double>(points.jacobian[k][i] * bins_per_grey_level);
  }
  double g = 0.0;
  double h = 0.0;
  auto cell = static_cast<std::size_t>(reference.bin * side + live.bin);
  for (std::size_t a = 0; a < kSplineSupport; ++a, cell += static_cast<std::size_t>(side)) {
    for (std::size_t b = 0; b < kSplineSupport; ++b) {
      const double ratio = log_ratio[cell + b];
      const auto product = static_cast<double>(first[a] * weights[b]);
      g += product * ratio;
      h += static_cast<double>(second[a] * weights[b]) * ratio;
      sums.joint_derivative[cell + b] += product * J;
    }
  }
  sums.gradient += g * J;
  std::size_t entry = 0;
  const double g_grey = g * static_cast<double>(bins_per_grey_level);
  for (int row = 0; row < 6; ++row) {
    const double hJ = h * J[row];
    for (int column = row; column < 6; ++column) {
      sums.curvature(row, column) +=
          hJ * J[column] + g_grey * static_cast<double>(points.second_derivative[entry++][i]);
    }
  }
}

}  // namespace

MiDerivatives mutualInformationDerivatives(const ReferencePoints& points,
                                           const MiReference& reference,
                                           const std::vector<BinPosition>& live,
                                           const std::vector<float>& visible,
                                           std::size_t num_visible, const JointHistogram& histogram,
                                           int threads) {
  MiDerivatives result;
  if (num_visible == 0) return result;
  const int side = histogram.side();
  const std::vector<double> log_ratio = logRatios(histogram);
  std::vector<Sums> parts(numChunks(points.size()), Sums(log_ratio.size()));
  forEachChunk(points.size(), threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      // A clamped intensity stays where it is under small motions.
      if (visible[i] == 0.0F || reference.bins[i].is_clamped) continue;
      addPoint(points, reference.bins[i], live[i], reference.bins_per_grey_level, log_ratio, side,
               i, parts[chunk]);
    }
  });
  Sums sums(log_ratio.size());
  for (const Sums& part : parts) {
    for (std::size_t cell = 0; cell < log_ratio.size(); ++cell) {
      sums.joint_derivative[cell] += part.joint_derivative[cell];
    }
    sums.gradient += part.gradient;
    sums.curvature += part.curvature;
  }

  const double n_inverse = 1.0 / static_cast<double>(num_visible);
  Matrix6 windows = Matrix6::Zero();
  for (int r = 0; r < side; ++r) {
    Vector6 marginal = Vector6::Zero();
    for (int l = 0; l < side; ++l) {
      const Vector6 dp = sums.joint_derivative[static_cast<std::size_t>(r * side + l)] * n_inverse;
      const double p = histogram.joint(r, l);
      if (p > 0.0) windows += dp * dp.transpose() / p;
      marginal += dp;
    }
    const double p = histogram.referenceMarginal(r);
    if (p > 0.0) windows -= marginal * marginal.transpose() / p;
  }
  result.gradient = sums.gradient * n_inverse;
  const Matrix6 curvature = sums.curvature.selfadjointView<Eigen::Upper>();
  result.hessian = windows + n_inverse * curvature;
  return result;
}

}  // namespace mivo
