// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "mivo/core/camera.h"

namespace mivo {

/// One image with registered depth, the input of Odometry. After Odometry::process has returned,
/// the pixels are not read again and may be overwritten. Their memory stays referenced until later
/// frames replace it.
struct Frame {
  double stamp = 0.0;  ///< s
  cv::Mat image;       ///< CV_8UC1, gray
  cv::Mat depth;  ///< same size: CV_32FC1 in meters, or CV_16UC1 in depth_unit; values that are not
                  ///< finite or not positive mean no reading
  double depth_unit = 0.001;  ///< meters per step of a CV_16UC1 depth
};

/// Order of the channels of a color image.
enum class ChannelOrder { kRgb, kBgr };

/// Gray image of a CV_8U or CV_16U image with 1, 3 or 4 channels. Of 16 bits, the 8 highest of the
/// `bits` in use are taken (see GrayRange for a stream). A gray 8-bit image is returned without a
/// copy. Throws Error for any other type. All inputs of mivo use this function, so that folders,
/// bags and cameras give identical bits.
cv::Mat toGray(const cv::Mat& image, ChannelOrder order, int bits = 16);

/// One line that says why a frame cannot be used with this camera; empty if it can.
std::string findFault(const Frame& frame, const Camera& camera);

}  // namespace mivo
