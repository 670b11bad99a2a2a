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

/// An image as it came, raw or compressed: it is decoded only when its turn has come.
struct ImageMessage {
  std_msgs::Header header;
  sensor_msgs::ImageConstPtr raw;  ///< one of the two is set
  sensor_msgs::CompressedImageConstPtr compressed;
  ros::WallTime arrival;  ///< in this node

  /// As the functions of the same names for messages.
  ColourImage toColourImage() const {
    return raw ? mivo::toColourImage(*raw) : mivo::toColourImage(*compressed);
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

/// Where a depth camera is that is not the colour camera.
struct DepthGeometry {
  sensor_msgs::CameraInfoConstPtr camera_info;
  Eigen::Isometry3d T_colour_depth;  ///< its pose in the colour camera
};

/// A colour image, the depth image that belongs to it, and the calibration of both.
struct ImagePair {
  ImageMessageConstPtr colour;
  ImageMessageConstPtr depth;
  sensor_msgs::CameraInfoConstPtr camera_info;
  sensor_msgs::CameraInfoConstPtr depth_info = nullptr;  ///< null where depth has none of its own
  std::string fault = "";  ///< why it cannot be believed; empty: it can
  std::optional<DepthGeometry> depth_geometry =
      std::nullopt;  ///< nothing: depth is registered to colour

  /// When both were there.
  ros::WallTime arrival() const { return std::max(colour->arrival, depth->arrival); }
};

}  // namespace mivo
