// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/alignment.h"

#include <Eigen/LU>
#include <cmath>

namespace mivo {

Eigen::Isometry3d rigidAlignment(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  Eigen::Isometry3d T;
  T.matrix() = Eigen::umeyama(from, to, false);
  return T;
}

double similarityScale(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Matrix3Xd centered = from.colwise() - from.rowwise().mean();
  if (!(centered.squaredNorm() > 0.0)) return 1.0;
  const Eigen::Matrix4d T = Eigen::umeyama(from, to, true);
  return std::cbrt(T.topLeftCorner<3, 3>().determinant());
}

}  // namespace mivo
