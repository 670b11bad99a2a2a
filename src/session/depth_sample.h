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

/// How the values of a 16-bit depth image are stored, as far as they show it.
struct DepthStorage {
  /// Three bits that are always 0: the values are multiples of 8, as when they were rotated to the
  /// left (SUN RGB-D, SUN3D).
  bool is_multiple_of_8 = false;
  /// Neighbors lie far apart, and do not when the bits are rotated by three to the left.
  bool is_rotated_right = false;
  /// m; the least difference of two readings, when it is a large part of the readings themselves:
  /// depth of 8 bits or fewer. Otherwise 0.
  double coarse_step = 0.0;
};

/// Of a frame that fits its camera; nothing is found in depth of 32 bits, or in few readings.
DepthStorage examineDepthStorage(const Frame& frame);

}  // namespace mivo
