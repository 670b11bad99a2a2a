// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/se3.h"

namespace mivo {

/// Agreement of the derivatives of keyframe and live frame. Noise gives the keyframe's derivatives
/// a curvature even in directions without structure. The noise of the live frame is independent of
/// it, so that sums of products of both retain the common structure only.
struct Agreement {
  Matrix6 keyframe = Matrix6::Zero();  ///< sum of J Jᵀ, J by the keyframe
  Matrix6 live = Matrix6::Zero();      ///< sum of L Lᵀ, L by the live frame
  Matrix6 both = Matrix6::Zero();      ///< sum of J Lᵀ, symmetric part
  int points = 0;                      ///< number of compared points
  /// The steps of oblique edges give both frames the same derivatives along the edges: images only.
  bool has_steps = false;

  void add(const Vector6& by_keyframe, const Vector6& by_live) {
    keyframe += by_keyframe * by_keyframe.transpose();
    live += by_live * by_live.transpose();
    both += 0.5 * (by_keyframe * by_live.transpose() + by_live * by_keyframe.transpose());
    ++points;
  }
};

}  // namespace mivo
