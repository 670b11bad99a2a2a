// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/keyframe_policy.h"

#include <algorithm>

namespace mivo {
namespace {

// motion > patience * limit, overlap < 1 - patience * (1 - limit): factor by which a keyframe is
// used longer than usual. Safe, because the margin below applies before the camera is lost.
constexpr double kPatienceInTheDark = 4.0;
constexpr double kPatienceWithBlur = 1.6;
// overlap < lost_overlap + this: a keyframe is replaced before its overlap becomes so small that
// frames are lost.
constexpr double kOverlapMargin = 0.1;

/// A dark or blurred image is a poor reference, so that the current keyframe is used longer.
/// Returns the factor.
double patienceWith(const Alignment& alignment, const KeyframeQuality& first,
                    const Parameters& parameters) {
  if (alignment.isDepthOnly()) return kPatienceInTheDark;
  const bool is_blurred =
      parameters.alignment.photometric_model == PhotometricModel::kLcn &&
      alignment.correlation < parameters.keyframes.keyframe_sharpness * first.correlation;
  return is_blurred ? kPatienceWithBlur : 1.0;
}

}  // namespace

bool needsNewKeyframe(const Alignment& alignment, const Keyframe& keyframe,
                      const KeyframeQuality& first, const Parameters& parameters) {
  if (parameters.keyframes.keyframe_policy == KeyframePolicy::kFirst) return false;
  // The light has returned: images can be compared again.
  if (alignment.is_keyframe_dark && !alignment.is_live_dark) return true;
  const Vector6 motion = localCoordinates(alignment.T_live_ref.inverse());
  const double patience = patienceWith(alignment, first, parameters);
  const double least_overlap = 1.0 - patience * (1.0 - parameters.keyframes.keyframe_overlap);
  if (motion.head<3>().norm() >
          patience * parameters.keyframes.keyframe_translation * keyframe.medianDepth() ||
      motion.tail<3>().norm() > patience * parameters.keyframes.keyframe_rotation ||
      alignment.overlap < std::max(least_overlap, parameters.loss.lost_overlap + kOverlapMargin)) {
    return true;
  }
  if (alignment.isDepthOnly()) return false;
  const double ratio = parameters.keyframes.keyframe_mutual_information;
  const bool less_information = first.mutual_information > 0.0 &&
                                alignment.mutual_information < ratio * first.mutual_information;
  // Without mutual information (method ssd) the residuals decide.
  const bool larger_residuals = first.mutual_information == 0.0 && first.residual_scale > 0.0 &&
                                ratio * alignment.residual_scale > first.residual_scale;
  return less_information || larger_residuals;
}

}  // namespace mivo
