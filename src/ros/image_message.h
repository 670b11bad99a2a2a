// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <optional>
#include <string>

#include "ros/image_conversion.h"

namespace mivo {

/// An image message, raw or compressed, decoded only when it is tracked.
struct ImageMessage {
  std_msgs::Header header;
  sensor_msgs::ImageConstPtr raw;  ///< one of the two is set
  sensor_msgs::CompressedImageConstPtr compressed;
  ros::WallTime arrival;  ///< in this node

  /// Of the pixels.
  std::size_t bytes() const { return raw ? raw->data.size() : compressed->data.size(); }

  /// See the functions of the same names for messages.
  ColorImage toColorImage() const {
    return raw ? mivo::toColorImage(*raw) : mivo::toColorImage(*compressed);
  }
  DepthImage toDepthImage() const {
    return raw ? mivo::toDepthImage(*raw) : mivo::toDepthImage(*compressed);
  }
};

using ImageMessageConstPtr = boost::shared_ptr<const ImageMessage>;

inline ImageMessageConstPtr wrap(const sensor_msgs::ImageConstPtr& message) {
  return boost::make_shared<ImageMessage>(
      ImageMessage{message->header, message, nullptr, ros::WallTime::now()});
}
inline ImageMessageConstPtr wrap(const sensor_msgs::CompressedImageConstPtr& message) {
  return boost::make_shared<ImageMessage>(
      ImageMessage{message->header, nullptr, message, ros::WallTime::now()});
}

/// Geometry of a depth camera that is not registered to the color camera.
struct DepthGeometry {
  sensor_msgs::CameraInfoConstPtr camera_info;
  Eigen::Isometry3d T_color_depth;  ///< pose of the depth camera in the color camera
};

/// A color image, its depth image, and the calibration of both.
struct ImagePair {
  ImageMessageConstPtr color;
  ImageMessageConstPtr depth;
  sensor_msgs::CameraInfoConstPtr camera_info;
  sensor_msgs::CameraInfoConstPtr depth_info = nullptr;  ///< null where depth has none of its own
  std::string fault = "";  ///< why it cannot be believed; empty: it can
  std::optional<DepthGeometry> depth_geometry =
      std::nullopt;  ///< nothing: depth is registered to color

  std::size_t bytes() const { return color->bytes() + depth->bytes(); }

  /// Arrival of the later one.
  ros::WallTime arrival() const { return std::max(color->arrival, depth->arrival); }
};

}  // namespace mivo
