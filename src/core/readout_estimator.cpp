// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/readout_estimator.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "mivo/core/robust_weight.h"

namespace mivo {

ReadoutMeasurement measureReadout(const ReferencePoints& points, const Residuals& residuals,
                                  const std::vector<float>& live_rows, double height, double scale,
                                  const RowVelocities& velocities) {
  // A longer read-out moves a point of the keyframe, as the live image sees it, by
  // tau_live (live velocity) - tau_keyframe (keyframe velocity), both in the keyframe's axes.
  const Eigen::Matrix3d R = velocities.T_live_ref.linear();
  const Eigen::Vector3d t = velocities.T_live_ref.translation();
  Vector6 live;
  live << R.transpose() * (velocities.live.tail<3>().cross(t) + velocities.live.head<3>()),
      R.transpose() * velocities.live.tail<3>();
  using Matrix7 = Eigen::Matrix<double, 7, 7>;
  using Vector7 = Eigen::Matrix<double, 7, 1>;
  Matrix7 H = Matrix7::Zero();
  Vector7 b = Vector7::Zero();
  const auto inverse_scale = static_cast<float>(1.0 / scale);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (residuals.visible[i] == 0.0F) continue;
    const float u = residuals.value[i] * inverse_scale;
    const auto weight = static_cast<double>(robustLoss(RobustWeight::kTukey, u).weight);
    Vector7 J;
    for (std::size_t k = 0; k < 6; ++k) {
      J[static_cast<int>(k)] = static_cast<double>(points.jacobian[k][i] * inverse_scale);
    }
    const double tau_live = static_cast<double>(live_rows[i]) / height - 0.5;
    const double tau_keyframe = points.pixels[i].y / height - 0.5;
    J[6] = tau_keyframe * J.head<6>().dot(velocities.keyframe) - tau_live * J.head<6>().dot(live);
    H += weight * J * J.transpose();
    b += weight * static_cast<double>(u) * J;
  }
  ReadoutMeasurement measurement;
  const Eigen::LDLT<Matrix6> pose(H.topLeftCorner<6, 6>());
  if (pose.info() != Eigen::Success || !pose.isPositive()) return measurement;
  const Vector6 coupling = pose.solve(H.topRightCorner<6, 1>());
  const double information = H(6, 6) - coupling.dot(H.topRightCorner<6, 1>());
  const double gradient = b[6] - coupling.dot(b.head<6>());
  if (!(information > 0.0) || !std::isfinite(gradient)) return measurement;
  measurement.correction = gradient / information;
  measurement.information = information;
  return measurement;
}

}  // namespace mivo
