// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

#include "mivo/core/camera.h"

namespace mivo {

/// Whether a topic carries rectified images, by image_proc's names: image_rect, image_rect_color.
bool isRectifiedTopic(const std::string& topic);

/// Camera of a calibration: K and D for raw images, P for rectified ones. Throws Error, with the
/// remedy, when it is empty, inconsistent, binned, or has a lens model other than plumb_bob. A
/// rational polynomial whose last three coefficients are zero is accepted.
Camera toCamera(const sensor_msgs::CameraInfo& message, bool rectified);

/// Calibration of a camera, as plumb_bob. The header is left empty.
sensor_msgs::CameraInfo toCameraInfo(const Camera& camera);

}  // namespace mivo
