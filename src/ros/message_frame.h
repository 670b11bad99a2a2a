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

/// What a pair of messages shows, before anything is made of the colours.
struct MessageImages {
  Camera camera;
  ColourImage colour;
  DepthImage depth;  ///< of the colour camera: registered, and as large
};

/// Makes frames of the pairs of one camera.
class FrameMaker {
 public:
  explicit FrameMaker(bool rectified) : rectified_(rectified) {}

  /// Throws Error with the reason when a message cannot be used or the messages do not match.
  MessageFrame make(const ImagePair& pair);

  /// The same, with the colours. Throws Error when a message cannot be used.
  MessageImages read(const ImagePair& pair);

  /// Grey image of colours; of 16 bits, by the range that the images have used so far.
  cv::Mat toGrey(const ColourImage& colour);

 private:
  DepthImage depthOf(const ImagePair& pair, const Camera& camera, const cv::Size& size);

  bool rectified_;
  GreyRange grey_range_;
  DepthRegistration registration_;
};

}  // namespace mivo
