// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/recovery.h"

#include <algorithm>

#include "mivo/core/se3.h"

namespace mivo {
namespace {

// Limits a lost frame to six alignments; four older keyframes take two frames.
constexpr std::size_t kOlderPerFrame = 2;
// m and rad; a shorter motion gives no other start.
constexpr double kStandingStill = 1e-6;

}  // namespace

RecoveryAttempts recoveryAttempts(const KeyframeStore& keyframes,
                                  const Eigen::Isometry3d& T_odom_last,
                                  const Eigen::Isometry3d& T_odom_predicted, int lost_in_a_row) {
  RecoveryAttempts attempts;
  attempts.add({0, T_odom_last});
  const Vector6 motion = logSe3(T_odom_last.inverse() * T_odom_predicted);
  if (motion.norm() > kStandingStill) {
    attempts.add({0, T_odom_predicted});
    attempts.add({0, orthonormalized(T_odom_last * expSe3(0.5 * motion))});
  }
  attempts.add({0, T_odom_last, false, 1});
  const std::size_t older = keyframes.size() - 1;
  const std::size_t first = kOlderPerFrame * static_cast<std::size_t>(lost_in_a_row);
  for (std::size_t i = 0; i < std::min(older, kOlderPerFrame); ++i) {
    const std::size_t index = 1 + (first + i) % older;
    attempts.add({index, keyframes.at(index).T_odom_keyframe});
  }
  return attempts;
}

}  // namespace mivo
