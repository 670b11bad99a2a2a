// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <random>

namespace mivo {

/// Random displacements of the poses at which tracking starts, to measure how far from the truth it
/// still converges. The same seed gives the same displacements on every platform.
class Disturbance {
 public:
  /// @param translation  norm of the translation, m
  /// @param rotation     norm of the rotation vector, rad
  Disturbance(double translation, double rotation, std::uint64_t seed);

  /// The next displacement: both directions are uniform on the sphere. To be multiplied from the
  /// right, so that it acts in the axes of the camera.
  Eigen::Isometry3d next();

 private:
  double uniform();  // [0, 1)
  Eigen::Vector3d direction();

  double translation_;
  double rotation_;
  std::mt19937_64 engine_;
};

}  // namespace mivo
