// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/geometric_term.h"

#include <algorithm>
#include <cmath>

namespace mivo {

GeometricTerm::GeometricTerm(const GeometricPoints& points, std::size_t num_points,
                             const FramePyramid& live, const Warp& warp,
                             const Parameters& parameters)
    : points_(points),
      num_points_(std::min(num_points, points.size())),
      live_(live),
      warp_(warp),
      sum_(RobustWeight::kTukey, 1.0, parameters) {
  for (std::vector<float>* array : {&u_, &v_, &in_view_, &residuals_.value, &residuals_.visible}) {
    array->resize(num_points_);
  }
  for (std::vector<float>& column : jacobian_) column.resize(num_points_);
}

double GeometricTerm::evaluate(const Eigen::Isometry3d& T_live_ref) {
  kernels::warpPoints(warp_.parameters(T_live_ref),
                      {points_.x.data(), points_.y.data(), points_.z.data()}, num_points_,
                      u_.data(), v_.data(), in_view_.data());
  const Eigen::Isometry3f T = T_live_ref.cast<float>();
  const Eigen::Isometry3f T_inverse = T_live_ref.inverse().cast<float>();
  residuals_.num_visible = 0;
  for (std::size_t i = 0; i < num_points_; ++i) addResidual(i, T, T_inverse);
  return sum_.cost(residuals_);
}

void GeometricTerm::addResidual(std::size_t i, const Eigen::Isometry3f& T_live_ref,
                                const Eigen::Isometry3f& T_ref_live) {
  residuals_.value[i] = 0.0F;
  residuals_.visible[i] = 0.0F;
  if (in_view_[i] == 0.0F) return;
  const int column = static_cast<int>(u_[i] + 0.5F);
  const int row = static_cast<int>(v_[i] + 0.5F);
  const float z = live_.depthAt(column, row);
  if (z <= 0.0F) return;
  // The ray of the whole pixel differs from that of the point by less than a pixel; distortion does
  // not matter over so short a way.
  const Camera& camera = warp_.camera();
  const Eigen::Vector3f X(points_.x[i], points_.y[i], points_.z[i]);
  Eigen::Vector3f q = T_live_ref * X;
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();
  if (!warp_.rows().isZero()) {
    shift = warp_.rows()
                .displacement(q.cast<double>(), static_cast<double>(v_[i]), camera.height)
                .cast<float>();
    q += shift;
  }
  const float inverse = 1.0F / q.z();
  const Eigen::Vector3f Y(
      z * (q.x() * inverse + (static_cast<float>(column) - u_[i]) / static_cast<float>(camera.fx)),
      z * (q.y() * inverse + (static_cast<float>(row) - v_[i]) / static_cast<float>(camera.fy)), z);
  const Eigen::Vector3f P = T_ref_live * (Y - shift);
  const Eigen::Vector3f n(points_.nx[i], points_.ny[i], points_.nz[i]);
  const float weight = points_.weight[i];
  residuals_.value[i] = weight * n.dot(P - X);
  residuals_.visible[i] = 1.0F;
  ++residuals_.num_visible;
  // The increment moves P to exp(w) P + v, so that r grows by n . v + (P x n) . w; the sums expect
  // r(d) = r - J d.
  const Eigen::Vector3f turn = P.cross(n);
  for (int k = 0; k < 3; ++k) {
    jacobian_[static_cast<std::size_t>(k)][i] = -weight * n[k];
    jacobian_[static_cast<std::size_t>(k) + 3][i] = -weight * turn[k];
  }
}

QuadraticModel GeometricTerm::linearise(int iteration) {
  std::array<const float*, 6> jacobian;
  for (std::size_t k = 0; k < 6; ++k) jacobian[k] = jacobian_[k].data();
  return sum_.linearise(residuals_, jacobian, iteration);
}

}  // namespace mivo
