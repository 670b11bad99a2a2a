// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/keyframe_store.h"

#include <algorithm>
#include <utility>

namespace mivo {

PosedKeyframe& KeyframeStore::candidate() {
  if (spare_.empty()) spare_.push_back(std::make_unique<PosedKeyframe>());
  return *spare_.back();
}

void KeyframeStore::promote(std::size_t num_recent) {
  candidate();
  keyframes_.insert(keyframes_.begin(), std::move(spare_.back()));
  spare_.pop_back();
  while (keyframes_.size() > num_recent + 1) {
    spare_.push_back(std::move(keyframes_.back()));
    keyframes_.pop_back();
  }
}

void KeyframeStore::choose(std::size_t index) {
  const auto chosen = keyframes_.begin() + static_cast<std::ptrdiff_t>(index);
  std::rotate(keyframes_.begin(), chosen, chosen + 1);
}

void KeyframeStore::clear() {
  for (auto& keyframe : keyframes_) spare_.push_back(std::move(keyframe));
  keyframes_.clear();
}

void KeyframeStore::transform(const Eigen::Isometry3d& T_new_old) {
  for (auto& keyframe : keyframes_) {
    keyframe->T_odom_keyframe = orthonormalized(T_new_old * keyframe->T_odom_keyframe);
  }
}

}  // namespace mivo
