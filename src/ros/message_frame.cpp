// SPDX-License-Identifier: BSD-3-Clause
#include "ros/message_frame.h"

#include "mivo/core/error.h"
#include "ros/camera_conversion.h"
#include "ros/stamp.h"

namespace mivo {

DepthImage FrameMaker::depthOf(const ImagePair& pair, const Camera& camera, const cv::Size& size) {
  const DepthImage depth = pair.depth->toDepthImage();
  if (!pair.depth_geometry) return enlargeDepth(depth, size);
  // Names of depth topics say rectified as those of color do, but what a driver calls so has no
  // distortion either way.
  const Camera depth_camera =
      toCamera(*pair.depth_geometry->camera_info, false, depth.image.size());
  return registration_.toColor(depth, depth_camera, camera, pair.depth_geometry->T_color_depth);
}

MessageImages FrameMaker::read(const ImagePair& pair) {
  MessageImages images;
  images.color = pair.color->toColorImage();
  images.camera = toCamera(*pair.camera_info, rectified_, images.color.image.size());
  images.depth = depthOf(pair, images.camera, images.color.image.size());
  return images;
}

cv::Mat FrameMaker::toGray(const ColorImage& color) {
  return mivo::toGray(color.image, color.order, gray_range_.include(color.image));
}

MessageFrame FrameMaker::make(const ImagePair& pair) {
  const MessageImages images = read(pair);
  MessageFrame result;
  result.camera = images.camera;
  result.frame.stamp = toSeconds(pair.color->header.stamp);
  result.frame.image = toGray(images.color);
  result.frame.depth = images.depth.image;
  result.frame.depth_unit = images.depth.unit;
  const std::string fault = findFault(result.frame, result.camera);
  if (!fault.empty()) throw Error(fault);
  return result;
}

}  // namespace mivo
