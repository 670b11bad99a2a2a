// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>

#include "mivo/core/frame.h"

namespace mivo {

/// Depth in the form required by Frame.
struct DepthImage {
  cv::Mat image;        ///< CV_16UC1 in `unit`, or CV_32FC1 in meters
  double unit = 0.001;  ///< meters per step of a CV_16UC1 image
};

/// An image of the color camera.
struct ColorImage {
  cv::Mat image;  ///< CV_8U or CV_16U with 1, 3 or 4 channels
  ChannelOrder order = ChannelOrder::kBgr;
};

/// Image of a color message: mono8, mono16, rgb8, bgr8, rgba8, bgra8 and the same with 16 bits,
/// 8UC1, 8UC3, 8UC4, bayer_*8 and bayer_*16, yuv422, yuyv, nv12, nv21.
/// Avoids copies: the result may reference the message's pixels and must not outlive them. Throws
/// Error, with the remedy, for another encoding or a message with inconsistent sizes.
ColorImage toColorImage(const sensor_msgs::Image& message);

/// The same of a JPEG or PNG message of the transport "compressed"; a mosaic in it is demosaiced.
/// Throws Error.
ColorImage toColorImage(const sensor_msgs::CompressedImage& message);

/// Gray image of either message, of 16 bits the highest: toGray(toColorImage(message)).
template <typename Message>
cv::Mat toGrayImage(const Message& message) {
  const ColorImage color = toColorImage(message);
  return toGray(color.image, color.order);
}

/// Depth of a message: 16UC1 or mono16 in millimeters, 32FC1 in meters, both byte orders. The
/// result refers to the message's pixels when they are in this machine's byte order. Throws Error.
DepthImage toDepthImage(const sensor_msgs::Image& message);

/// Depth of a message of the transport "compressedDepth" (PNG or RVL, 16UC1 or 32FC1), or of a
/// 16-bit PNG of the transport "compressed". Throws Error.
DepthImage toDepthImage(const sensor_msgs::CompressedImage& message);

}  // namespace mivo
