// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"
#include "ros/image_message.h"

namespace mivo {

/// What a pair of messages says, ready for the tracker.
struct MessageFrame {
  Camera camera;
  Frame frame;  ///< refers to the pixels of the messages
};

/// Throws Error with the reason when a message cannot be used or they do not fit together.
MessageFrame toFrame(const ImagePair& pair, bool rectified);

/// A look at the depth, at every eighth pixel of every eighth row.
struct DepthSample {
  double coverage = 0.0;  ///< part of the pixels with a reading, 0 to 1
  double median = 0.0;    ///< m, of the readings; 0: none
};
DepthSample sampleDepth(const Frame& frame);

}  // namespace mivo
