// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/keyframe/keyframe.h"
#include "mivo/core/se3.h"

namespace mivo {

/// A keyframe with its pose.
struct PosedKeyframe {
  Keyframe keyframe;
  Eigen::Isometry3d T_odom_keyframe = Eigen::Isometry3d::Identity();
  /// Of the error of T_odom_keyframe, in the keyframe's axes, see TrackingResult::covariance.
  Matrix6 covariance = Matrix6::Identity();
  /// Contrast of the last keyframe that was not dark: this one's, unless it was created in the
  /// dark. See AlignmentTask::last_lit_contrast.
  double last_lit_contrast = 0.0;
  int number = 0;   ///< from 1
  int segment = 0;  ///< keyframes of one segment are connected by measurements
};

/// The current keyframe, previous ones for recovery, and a candidate for the next. Memory is
/// reused.
class KeyframeStore {
 public:
  bool isEmpty() const { return keyframes_.empty(); }

  /// Precondition: not empty.
  PosedKeyframe& current() { return *keyframes_.front(); }
  const PosedKeyframe& current() const { return *keyframes_.front(); }

  /// All keyframes, most recently used first.
  std::size_t size() const { return keyframes_.size(); }
  const PosedKeyframe& at(std::size_t index) const { return *keyframes_[index]; }

  /// Keyframe to be filled. promote() makes it the current one and keeps at most `num_recent`
  /// others.
  PosedKeyframe& candidate();
  void promote(std::size_t num_recent);

  /// Makes a previous keyframe the current one.
  void choose(std::size_t index);

  void clear();

  /// Moves the world: T_odom_keyframe becomes T_new_old T_odom_keyframe.
  void transform(const Eigen::Isometry3d& T_new_old);

 private:
  std::vector<std::unique_ptr<PosedKeyframe>> keyframes_;
  std::vector<std::unique_ptr<PosedKeyframe>> spare_;
};

}  // namespace mivo
