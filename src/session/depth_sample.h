// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/frame.h"

namespace mivo {

/// Statistics of a depth image, from every eighth pixel of every eighth row.
struct DepthSample {
  double coverage = 0.0;  ///< part of the pixels with a reading, 0 to 1
  double median = 0.0;    ///< m, of the readings; 0: none
};

/// Precondition: the frame matches its camera.
DepthSample sampleDepth(const Frame& frame);

}  // namespace mivo
