// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"
#include "ros/depth_registration.h"
#include "ros/image_message.h"
#include "session/grey_range.h"

namespace mivo {

/// A pair of messages converted for the tracker.
struct MessageFrame {
  Camera camera;
  Frame frame;  ///< references the pixels of the messages
};

/// The content of a pair of messages, before conversion to grey.
struct MessageImages {
  Camera camera;
  ColourImage colour;
  DepthImage depth;  ///< registered to the colour camera and of its size
};

/// Creates the frames of one camera from pairs of messages.
class FrameMaker {
 public:
  explicit FrameMaker(bool rectified) : rectified_(rectified) {}

  /// Throws Error with the reason when a message cannot be used or the messages do not match.
  MessageFrame make(const ImagePair& pair);

  /// The same, with colour. Throws Error when a message cannot be used.
  MessageImages read(const ImagePair& pair);

  /// Grey image of a colour image; 16 bits are scaled by the range of the images so far.
  cv::Mat toGrey(const ColourImage& colour);

 private:
  DepthImage depthOf(const ImagePair& pair, const Camera& camera, const cv::Size& size);

  bool rectified_;
  GreyRange grey_range_;
  DepthRegistration registration_;
};

}  // namespace mivo
