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

}  // namespace mivo
