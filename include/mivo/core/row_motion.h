// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/se3.h"

namespace mivo {

/// Motion of the scene in a camera's axes while the rows of one image are read, from the first to
/// the last: a point X is at X + tau (w x X + v), tau = row / height - 1/2, when the row is read.
/// The pose of a frame is that of its middle row. Zero for a global shutter.
struct RowMotion {
  Vector6 twist = Vector6::Zero();  ///< (v, w), m and rad per read-out

  bool isZero() const { return twist.isZero(0.0); }

  /// Displacement of a point of a row, metres.
  Eigen::Vector3d displacement(const Eigen::Vector3d& point, double row, double height) const {
    const double tau = row / height - 0.5;
    return tau * (twist.tail<3>().cross(point) + twist.head<3>());
  }
};

}  // namespace mivo
