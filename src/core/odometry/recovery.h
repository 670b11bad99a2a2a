// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "core/keyframe/keyframe_store.h"

namespace mivo {

/// One way to find a lost camera again: a keyframe of the store, and where to start.
struct RecoveryAttempt {
  std::size_t keyframe = 0;
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
  bool is_expected = false;  ///< it is where the motion so far leads
  int skipped_levels = 0;    ///< coarsest levels to leave out: they may have led astray
};

/// The attempts in their order; a frame allocates nothing.
class RecoveryAttempts {
 public:
  void add(const RecoveryAttempt& attempt) { attempts_[size_++] = attempt; }
  std::size_t size() const { return size_; }
  const RecoveryAttempt& operator[](std::size_t index) const { return attempts_[index]; }
  const RecoveryAttempt* begin() const { return attempts_.data(); }
  const RecoveryAttempt* end() const { return attempts_.data() + size_; }

 private:
  std::array<RecoveryAttempt, 6> attempts_;
  std::size_t size_ = 0;
};

/// What to try with a frame that the usual start does not align: from the last good pose, from the
/// motion before the loss continued, from half of it, and from the last good pose without the
/// coarsest level, against the current keyframe; and from their own poses against two of the older
/// keyframes, others with every lost frame.
/// @param T_odom_last last good pose. @param T_odom_predicted where its motion would have led.
/// @param lost_in_a_row frames lost before this one.
RecoveryAttempts recoveryAttempts(const KeyframeStore& keyframes,
                                  const Eigen::Isometry3d& T_odom_last,
                                  const Eigen::Isometry3d& T_odom_predicted, int lost_in_a_row);

}  // namespace mivo
