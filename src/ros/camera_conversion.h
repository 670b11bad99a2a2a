// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core/types.hpp>
#include <string>

#include "mivo/core/camera.h"

namespace mivo {

/// Whether a topic carries rectified images, by image_proc's names: image_rect, image_rect_color.
bool isRectifiedTopic(const std::string& topic);

/// Camera of a calibration: K and D for raw images, P for rectified ones, after the region of
/// interest and the binning of the image. Lens models: plumb_bob, rational_polynomial with 8
/// coefficients, equidistant; any model with only zeros is a pinhole. Throws Error, with the
/// remedy, when it is empty, inconsistent, implausible (Camera::validate), or has another lens
/// model.
/// @param image_size  of the images; used when the message has the size 0 x 0
Camera toCamera(const sensor_msgs::CameraInfo& message, bool rectified,
                const cv::Size& image_size = {});

/// Calibration of a camera. The header is left empty.
sensor_msgs::CameraInfo toCameraInfo(const Camera& camera);

}  // namespace mivo
