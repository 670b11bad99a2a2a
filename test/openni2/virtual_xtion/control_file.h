// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace virtual_xtion {

/// What the virtual camera is told to do: lines "name value" of the file that the environment
/// variable MIVO_VIRTUAL_XTION names. It may change at any time; write it elsewhere and rename it.
struct Control {
  std::string folder;          ///< sequence in TUM layout, 640x480
  std::string truth;           ///< file that gets a line for each image taken: see Truth
  bool decode_first = false;   ///< all images are decoded when a camera is opened
  int devices = 1;             ///< cameras to offer
  bool present = true;         ///< plugged in
  bool in_use = false;         ///< another process has it
  bool no_permission = false;  ///< the USB node may not be opened
  bool color = true;           ///< has a color camera
  bool registration = true;    ///< can register depth to color
  bool settings = true;        ///< has exposure, gain and white balance
  bool deaf = false;           ///< ignores settings for good
  std::size_t until = 0;       ///< image up to which the sequence plays, each taken once
  int pace = 1;                ///< the sequence, and with it the camera, is slower by this
  int rate = 30;               ///< Hz that get through USB; images in between are lost
  int drop_every = 0;          ///< every n-th image is lost; 0: none
  bool color_stalls = false;   ///< no more color images
  bool depth_stalls = false;   ///< no more depth images
  double depth_delay = 0.0;    ///< s that depth arrives later
  double jitter = 0.0;         ///< s, mean of the random delay of arrivals
  double clock_ppm = 0.0;      ///< the device's clock is faster by this
};

/// Reads the file; throws std::runtime_error for a line that it does not understand.
Control readControl(const std::string& path);

/// Path in the environment, or empty.
std::string controlPath();

}  // namespace virtual_xtion
