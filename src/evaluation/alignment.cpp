// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/alignment.h"

namespace mivo {

Eigen::Isometry3d rigidAlignment(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  Eigen::Isometry3d T;
  T.matrix() = Eigen::umeyama(from, to, false);
  return T;
}

}  // namespace mivo
