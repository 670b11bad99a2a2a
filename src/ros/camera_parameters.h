// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "openni2/camera_session.h"

namespace mivo {

/// Parameters of the camera node that are read once at startup. Those that can change at run time
/// are in config/OpenNI2.cfg.
struct CameraParameters {
  DeviceRequest device;                 ///< parameters device, width, height, rate, depth_unit (m),
                                        ///< depth_registration, depth_synchronization, repeat
  SessionTimes times;                   ///< parameter warm_up_images
  std::string frame_prefix = "camera";  ///< of all frames: camera_link, camera_rgb_frame, ...
  std::string rgb_camera_info_url;      ///< empty: ~/.ros/camera_info/NAME.yaml when there is one
  std::string depth_camera_info_url;    ///< used only without registration
  bool publish_tf = true;               ///< static transforms of the camera's frames
  double pair_tolerance = 0.0;  ///< s, between color and depth of a pair; 0: 0.4 of the period

  std::string linkFrame() const { return frame_prefix + "_link"; }
  std::string rgbFrame() const { return frame_prefix + "_rgb_frame"; }
  std::string rgbOpticalFrame() const { return frame_prefix + "_rgb_optical_frame"; }
  std::string depthFrame() const { return frame_prefix + "_depth_frame"; }
  std::string depthOpticalFrame() const { return frame_prefix + "_depth_optical_frame"; }
};

/// Throws Error, naming the parameter, for a wrong type or value.
CameraParameters readCameraParameters(const ros::NodeHandle& node);

}  // namespace mivo
