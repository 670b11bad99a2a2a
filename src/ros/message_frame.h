// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"
#include "ros/image_message.h"

namespace mivo {

/// A pair of messages converted for the tracker.
struct MessageFrame {
  Camera camera;
  Frame frame;  ///< references the pixels of the messages
};

/// Throws Error with the reason when a message cannot be used or the messages do not match.
MessageFrame toFrame(const ImagePair& pair, bool rectified);

}  // namespace mivo
