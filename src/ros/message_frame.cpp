// SPDX-License-Identifier: BSD-3-Clause
#include "ros/message_frame.h"

#include "mivo/core/error.h"
#include "ros/camera_conversion.h"
#include "ros/stamp.h"

namespace mivo {
MessageFrame toFrame(const ImagePair& pair, bool rectified) {
  MessageFrame result;
  result.camera = toCamera(*pair.camera_info, rectified);
  result.frame.stamp = toSeconds(pair.colour->header.stamp);
  const ColourImage colour = pair.colour->toColourImage();
  result.frame.image = toGrey(colour.image, colour.order);
  const DepthImage depth = pair.depth->toDepthImage();
  result.frame.depth = depth.image;
  result.frame.depth_unit = depth.unit;
  const std::string fault = findFault(result.frame, result.camera);
  if (!fault.empty()) throw Error(fault);
  return result;
}

}  // namespace mivo
