// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/alignment/align.h"
#include "core/keyframe/keyframe.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// Quality of the first alignment after the keyframe was created, the reference for later frames.
struct KeyframeQuality {
  double mutual_information = 0.0;  ///< nats; 0: not known
  double residual_scale = 0.0;      ///< gray levels; 0: not known
  double correlation = 0.0;         ///< 0: not known
};

/// Whether the frame that was just aligned should become the next keyframe: by motion, overlap or
/// cost (see the keyframe_* parameters).
bool needsNewKeyframe(const Alignment& alignment, const Keyframe& keyframe,
                      const KeyframeQuality& first, const Parameters& parameters);

}  // namespace mivo
