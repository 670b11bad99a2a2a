// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/keyframe_policy.h"

namespace mivo {

bool needsNewKeyframe(const Alignment& alignment, const Keyframe& keyframe,
                      const KeyframeQuality& first, const Parameters& parameters) {
  if (parameters.keyframe_policy == KeyframePolicy::kFirst) return false;
  const Vector6 motion = localCoordinates(alignment.T_live_ref.inverse());
  if (motion.head<3>().norm() > parameters.keyframe_translation * keyframe.medianDepth() ||
      motion.tail<3>().norm() > parameters.keyframe_rotation ||
      alignment.overlap < parameters.keyframe_overlap) {
    return true;
  }
  const double ratio = parameters.keyframe_information;
  const bool less_information = first.mutual_information > 0.0 &&
                                alignment.mutual_information < ratio * first.mutual_information;
  // SSD alone has no mutual information; there the residuals speak.
  const bool larger_residuals = first.mutual_information == 0.0 && first.residual_scale > 0.0 &&
                                ratio * alignment.residual_scale > first.residual_scale;
  return less_information || larger_residuals;
}

}  // namespace mivo
