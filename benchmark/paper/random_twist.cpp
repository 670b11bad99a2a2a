// SPDX-License-Identifier: BSD-3-Clause
#include "random_twist.h"

#include "synthetic/pixel_noise.h"

namespace mivo {

Vector6 randomTwist(double magnitude, std::uint64_t seed, std::uint64_t series,
                    std::uint64_t trial) {
  // A vector of normal numbers has no preferred direction.
  Vector6 direction;
  for (int k = 0; k < 6; ++k) {
    const auto axis = static_cast<std::uint64_t>(k);
    direction[k] = static_cast<double>(gaussianFrom(hashOf(hashOf(seed, series), trial, axis)));
  }
  return magnitude * direction.normalized();
}

PoseDifference difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Vector6 error = logSe3(a * b.inverse());
  return {error.head<3>().norm(), error.tail<3>().norm()};
}

bool isSuccess(const PoseDifference& error) {
  return error.translation < kSuccessLimit && error.rotation < kSuccessLimit;
}

}  // namespace mivo
