// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OpenNI.h>

#include "openni2/camera_device.h"

namespace mivo {

/// Sets the requested mode, or accepts that of a recording. Throws DeviceError with the list of
/// what the device offers.
void setVideoMode(openni::VideoStream& stream, StreamKind kind, const DeviceRequest& request,
                  const DeviceDescription& device);

/// The image of a frame, which must outlive the view.
ImageView viewOf(openni::VideoFrameRef& frame);

}  // namespace mivo
