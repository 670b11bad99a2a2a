// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "core/keyframe/keyframe_store.h"

namespace mivo {

/// One attempt to relocalize a lost camera: a keyframe of the store and a start.
struct RecoveryAttempt {
  std::size_t keyframe = 0;
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
  bool is_expected = false;  ///< it is the prediction
  int skipped_levels =
      0;  ///< number of coarsest levels to skip: they may converge to a wrong minimum
};

/// The attempts in order, without allocation.
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

/// Attempts for a frame that is not aligned from the predicted pose. Against the current keyframe:
/// the last measured pose, the continued motion, half of it, and the last pose without the coarsest
/// level. Against two of the older keyframes, alternating from frame to frame: their own poses.
/// @param T_odom_last last good pose. @param T_odom_predicted where its motion would have led.
/// @param lost_in_a_row frames lost before this one.
RecoveryAttempts recoveryAttempts(const KeyframeStore& keyframes,
                                  const Eigen::Isometry3d& T_odom_last,
                                  const Eigen::Isometry3d& T_odom_predicted, int lost_in_a_row);

}  // namespace mivo
