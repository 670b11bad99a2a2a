// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/device_error.h"

namespace mivo {

const char* toString(DeviceFault fault) {
  switch (fault) {
    case DeviceFault::kNoDriver:
      return "no driver";
    case DeviceFault::kNoDevice:
      return "no device";
    case DeviceFault::kWrongAddress:
      return "wrong address";
    case DeviceFault::kInUse:
      return "in use";
    case DeviceFault::kNoPermission:
      return "no permission";
    case DeviceFault::kNoColor:
      return "no color camera";
    case DeviceFault::kNoDepth:
      return "no depth camera";
    case DeviceFault::kNoRegistration:
      return "no registration";
    case DeviceFault::kNoMode:
      return "mode not offered";
    case DeviceFault::kBadRecording:
      return "bad recording";
    case DeviceFault::kUsb:
      return "USB failure";
    case DeviceFault::kLost:
      return "connection lost";
    case DeviceFault::kUnexpected:
      return "unexpected";
  }
  return "unknown";
}

const char* adviceFor(DeviceFault fault) {
  switch (fault) {
    case DeviceFault::kNoDriver:
      return "Install libopenni2-0, which has the drivers in OpenNI2/Drivers beside the library";
    case DeviceFault::kNoDevice:
      return "Plug the camera in; lsusb shows it as 1d27:0600, 1d27:0601 or 1d27:0609. If it does "
             "not, try another cable or USB port";
    case DeviceFault::kWrongAddress:
      return "Set device to 'any', '#1', a serial number, a URI from this list, or the path of an "
             ".oni recording";
    case DeviceFault::kInUse:
      return "Close the other program that uses the camera (another driver node, NiViewer2)";
    case DeviceFault::kNoPermission:
      return "Install the udev rules of libopenni2-0 (or see doc/xtion.md) and plug the camera in "
             "again";
    case DeviceFault::kNoColor:
      return "Visual odometry needs color: use a model with a color camera (Xtion Pro Live, not "
             "Xtion Pro)";
    case DeviceFault::kNoDepth:
      return "Use a device or recording with depth";
    case DeviceFault::kNoRegistration:
      return "Set depth_registration to false and register with depth_image_proc/register, or use "
             "a device that registers depth itself";
    case DeviceFault::kNoMode:
      return "Set width, height, rate and depth_unit to a mode of this list";
    case DeviceFault::kBadRecording:
      return "Record it again, and stop the streams before the recorder";
    case DeviceFault::kUsb:
      return "Plug the camera in again, into a USB 2 port without a hub; see the table in "
             "doc/xtion.md for USB 3 (xHCI)";
    case DeviceFault::kLost:
      return "Check the cable and plug the camera in again";
    case DeviceFault::kUnexpected:
      return "The device will be reopened; if this persists, please report it";
  }
  return "";
}

}  // namespace mivo
