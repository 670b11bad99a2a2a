// SPDX-License-Identifier: BSD-3-Clause
#include "programs/disturbance.h"

#include <cmath>

#include "mivo/core/se3.h"

namespace mivo {

Disturbance::Disturbance(double translation, double rotation, std::uint64_t seed)
    : translation_(translation), rotation_(rotation), engine_(seed) {}

Eigen::Isometry3d Disturbance::next() {
  Vector6 d;
  d.head<3>() = translation_ * direction();
  d.tail<3>() = rotation_ * direction();
  return retract(d);
}

double Disturbance::uniform() {
  // The standard's distributions differ between libraries, its engines do not: 53 bits of one draw.
  return static_cast<double>(engine_() >> 11) * std::ldexp(1.0, -53);
}

Eigen::Vector3d Disturbance::direction() {
  // Archimedes: the height of a point on the sphere is uniform.
  const double z = 2.0 * uniform() - 1.0;
  const double longitude = 2.0 * M_PI * uniform();
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(longitude), radius * std::sin(longitude), z};
}

}  // namespace mivo
