// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mivo/core/error.h"

namespace mivo {

/// What keeps a camera from delivering images.
enum class DeviceFault {
  kNoDriver,        ///< libOpenNI2 finds none of its driver libraries
  kNoDevice,        ///< nothing is plugged in
  kWrongAddress,    ///< something is plugged in, but not what was asked for; or no such file
  kInUse,           ///< another process holds the camera
  kNoPermission,    ///< the USB node may not be written by this user
  kNoColor,         ///< the device has no color camera
  kNoDepth,         ///< the device has no depth camera
  kNoRegistration,  ///< the device cannot register depth to color
  kNoMode,          ///< size, rate or format is not offered
  kBadRecording,    ///< the file is no recording that can be played
  kUsb,             ///< the USB transfer could not be set up
  kLost,            ///< it delivered, and stopped
  kUnexpected       ///< something that none of the above explains
};

/// One or two words, e.g. "in use".
const char* toString(DeviceFault fault);

/// What the user can do about it: one sentence.
const char* adviceFor(DeviceFault fault);

/// The one exception of the camera. Its text is one line: what happened, and what to do.
class DeviceError : public Error {
 public:
  DeviceError(DeviceFault fault, const std::string& what_happened)
      : Error(what_happened + ". " + adviceFor(fault)), fault_(fault) {}

  DeviceFault fault() const { return fault_; }

 private:
  DeviceFault fault_;
};

}  // namespace mivo
