// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"
#include "ros/depth_registration.h"
#include "ros/image_message.h"
#include "session/gray_range.h"

namespace mivo {

/// A pair of messages converted for the tracker.
struct MessageFrame {
  Camera camera;
  Frame frame;  ///< references the pixels of the messages
};

/// The content of a pair of messages, before conversion to gray.
struct MessageImages {
  Camera camera;
  ColorImage color;
  DepthImage depth;  ///< registered to the color camera and of its size
};

/// Creates the frames of one camera from pairs of messages.
class FrameMaker {
 public:
  explicit FrameMaker(bool rectified) : rectified_(rectified) {}

  /// Throws Error with the reason when a message cannot be used or the messages do not match.
  MessageFrame make(const ImagePair& pair);

  /// The same, with color. Throws Error when a message cannot be used.
  MessageImages read(const ImagePair& pair);

  /// Gray image of a color image; 16 bits are scaled by the range of the images so far.
  cv::Mat toGray(const ColorImage& color);

 private:
  DepthImage depthOf(const ImagePair& pair, const Camera& camera, const cv::Size& size);

  bool rectified_;
  GrayRange gray_range_;
  DepthRegistration registration_;
};

}  // namespace mivo
