// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mivo/core/se3.h"

namespace mivo {

/// Twist number `trial` of an experiment: its direction is uniform in all six degrees of freedom,
/// with a meter counting as much as a radian, its norm is `magnitude`. A function of its arguments
/// alone, so that every method meets the same twists.
Vector6 randomTwist(double magnitude, std::uint64_t seed, std::uint64_t series,
                    std::uint64_t trial);

/// Norms of the translation (m) and of the rotation (rad) of logSe3(T_a T_b^-1).
struct PoseDifference {
  double translation;
  double rotation;
};
PoseDifference difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

/// The paper's success (IV-B2): both norms below 0.01.
constexpr double kSuccessLimit = 0.01;
bool isSuccess(const PoseDifference& error);

}  // namespace mivo
