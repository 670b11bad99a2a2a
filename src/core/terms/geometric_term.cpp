// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/geometric_term.h"

#include <algorithm>

#include "core/images/depth_pyramid.h"
#include "core/symmetric.h"
#include "core/terms/depth_agreement.h"

namespace mivo {

GeometricTerm::GeometricTerm(const GeometricPoints& points, std::size_t num_points,
                             const FramePyramid& live, const Warp& warp,
                             const Parameters& parameters)
    : points_(points),
      num_points_(std::min(num_points, points.size())),
      live_(live),
      warp_(warp),
      sum_(RobustWeight::kTukey, 1.0, parameters) {
  u_->resize(num_points_);
  v_->resize(num_points_);
  residuals_->value.resize(num_points_);
  residuals_->visible.resize(num_points_);
  for (std::vector<float>& column : *jacobian_) column.resize(num_points_);
}

double GeometricTerm::evaluate(const Eigen::Isometry3d& T_live_ref) {
  if (!is_measured_ || T_live_ref.matrix() != T_live_ref_.matrix()) measure(T_live_ref);
  return sum_.cost(*residuals_);
}

void GeometricTerm::measure(const Eigen::Isometry3d& T_live_ref) {
  const kernels::Kernels& kernels = kernels::active();
  const kernels::WarpParameters live = warp_.parameters(T_live_ref);
  const kernels::PlanesView planes = {{points_.x.data(), points_.y.data(), points_.z.data()},
                                      {points_.nx.data(), points_.ny.data(), points_.nz.data()},
                                      points_.weight.data()};
  kernels.warpPoints(live, planes.point, num_points_, u_->data(), v_->data(),
                     residuals_->visible.data());
  const Eigen::Isometry3d T_ref_live = T_live_ref.inverse();
  kernels::Motion back{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      back.rotation[3 * row + column] = static_cast<float>(T_ref_live.linear()(row, column));
    }
    back.translation[row] = static_cast<float>(T_ref_live.translation()[row]);
  }
  float* columns[6];
  for (std::size_t k = 0; k < 6; ++k) columns[k] = (*jacobian_)[k].data();
  residuals_->num_visible = kernels.geometricResiduals(
      live, back, planes, depthView(live_.frame()), u_->data(), v_->data(), num_points_,
      residuals_->visible.data(), residuals_->value.data(), columns);
  T_live_ref_ = T_live_ref;
  is_measured_ = true;
}

int GeometricTerm::gradientCovariance(Matrix6& covariance) const {
  std::array<const float*, 6> jacobian;
  for (std::size_t k = 0; k < 6; ++k) jacobian[k] = (*jacobian_)[k].data();
  return sum_.scoreCovariance(*residuals_, jacobian, *u_, *v_, warp_.camera(), covariance);
}

double GeometricTerm::overconfidence() {
  Matrix6 of_gradient;
  if (gradientCovariance(of_gradient) < kFewestBlocks) return 1.0;
  const Matrix6 ratio = symmetricSolve(linearize(0).hessian, of_gradient);
  return std::max(1.0, ratio.trace() / 6.0);
}

Agreement GeometricTerm::agreement(std::size_t most_points) const {
  return depthAgreement(points_, live_.frame(), warp_.camera(), *u_, *v_, residuals_->visible,
                        T_live_ref_, most_points);
}

QuadraticModel GeometricTerm::linearize(int iteration) {
  std::array<const float*, 6> jacobian;
  for (std::size_t k = 0; k < 6; ++k) jacobian[k] = (*jacobian_)[k].data();
  return sum_.linearize(*residuals_, jacobian, iteration);
}

}  // namespace mivo
