// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/keyframe/keyframe.h"
#include "mivo/core/se3.h"

namespace mivo {

/// A keyframe and where it is.
struct PosedKeyframe {
  Keyframe keyframe;
  Eigen::Isometry3d T_odom_keyframe = Eigen::Isometry3d::Identity();
  /// Of the error of T_odom_keyframe, in the keyframe's axes, see TrackingResult::covariance.
  Matrix6 covariance = Matrix6::Identity();
  /// Contrast of the last keyframe that images could be compared with: this one's, unless it was
  /// made in the dark. See AlignmentTask::last_lit_contrast.
  double last_lit_contrast = 0.0;
  int number = 0;   ///< from 1
  int segment = 0;  ///< keyframes of one segment are connected by measurements
};

/// The keyframe in use, some before it for recovery, and one to build the next into. Their memory
/// is used again.
class KeyframeStore {
 public:
  bool isEmpty() const { return keyframes_.empty(); }

  /// In use. Not when empty.
  PosedKeyframe& current() { return *keyframes_.front(); }
  const PosedKeyframe& current() const { return *keyframes_.front(); }

  /// All that are kept, by when they were last in use: the current one first.
  std::size_t size() const { return keyframes_.size(); }
  const PosedKeyframe& at(std::size_t index) const { return *keyframes_[index]; }

  /// To be filled; becomes the current one by promote(), which keeps at most `num_recent` others.
  PosedKeyframe& candidate();
  void promote(std::size_t num_recent);

  /// Makes a kept one the current one again.
  void choose(std::size_t index);

  void clear();

  /// Moves the world: T_odom_keyframe becomes T_new_old T_odom_keyframe.
  void transform(const Eigen::Isometry3d& T_new_old);

 private:
  std::vector<std::unique_ptr<PosedKeyframe>> keyframes_;
  std::vector<std::unique_ptr<PosedKeyframe>> spare_;
};

}  // namespace mivo
