// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/device_address.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "openni2/device_error.h"
#include "openni2/usb_access.h"

namespace mivo {
namespace {

using Devices = std::vector<OpenNi2Library::Listed>;

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string listOf(const Devices& devices) {
  if (devices.empty()) {
    return "no device is connected";
  }
  std::string text = "connected:";
  for (std::size_t i = 0; i < devices.size(); ++i) {
    text += (i == 0 ? " #" : ", #") + std::to_string(i + 1) + " " + devices[i].uri + " (" +
            devices[i].name + ")";
  }
  return text;
}

void openUri(const std::string& uri, const std::string& name, openni::Device& device) {
  if (device.open(uri.c_str()) != openni::STATUS_OK) {
    const std::string text = sdkError();
    DeviceFault fault = classifyOpenFailure(uri, text);
    if (fault == DeviceFault::kWrongAddress) {
      fault = DeviceFault::kUsb;  // it is listed, so the address is right
    }
    throw DeviceError(fault, name + " (" + uri + ") does not open: " + text);
  }
}

void openRecording(const std::string& path, openni::Device& device) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw DeviceError(DeviceFault::kWrongAddress, "There is no recording " + path);
  }
  if (access(path.c_str(), R_OK) != 0) {
    throw DeviceError(DeviceFault::kBadRecording, "The recording " + path + " is not readable");
  }
  if (device.open(path.c_str()) != openni::STATUS_OK) {
    throw DeviceError(DeviceFault::kBadRecording,
                      "The recording " + path + " does not open: " + sdkError());
  }
}

void openNumber(const Devices& devices, const std::string& address, openni::Device& device) {
  const std::string digits = address.substr(1);
  const bool is_number = !digits.empty() && digits.size() < 4 &&
                         std::all_of(digits.begin(), digits.end(),
                                     [](unsigned char c) { return std::isdigit(c) != 0; });
  const std::size_t number = is_number ? std::stoul(digits) : 0;
  if (number < 1 || number > devices.size()) {
    throw DeviceError(devices.empty() ? DeviceFault::kNoDevice : DeviceFault::kWrongAddress,
                      "There is no device " + address + "; " + listOf(devices));
  }
  openUri(devices[number - 1].uri, devices[number - 1].name, device);
}

// True when a listed device has the serial number; it is open then.
bool openSerial(const Devices& devices, const std::string& serial, openni::Device& device) {
  for (const OpenNi2Library::Listed& listed : devices) {
    // Only an open device tells its number; one that does not open is not the one we want, or shows
    // up as missing in the message.
    if (device.open(listed.uri.c_str()) != openni::STATUS_OK) {
      continue;
    }
    if (serialNumber(device) == serial) {
      return true;
    }
    device.close();
  }
  return false;
}

}  // namespace

void openAddress(const OpenNi2Library& library, const std::string& address,
                 openni::Device& device) {
  const Devices devices = library.devices();
  if (address.empty() || address == "any") {
    if (devices.empty()) {
      throw DeviceError(DeviceFault::kNoDevice, "No OpenNI2 camera is connected");
    }
    openUri(devices.front().uri, devices.front().name, device);
    return;
  }
  if (address.front() == '#') {
    openNumber(devices, address, device);
    return;
  }
  if (endsWith(address, ".oni")) {
    openRecording(address, device);
    return;
  }
  for (const OpenNi2Library::Listed& listed : devices) {
    if (listed.uri == address) {
      openUri(listed.uri, listed.name, device);
      return;
    }
  }
  // A driver may accept a URI that it does not list.
  if (openSerial(devices, address, device) || device.open(address.c_str()) == openni::STATUS_OK) {
    return;
  }
  DeviceFault fault = classifyOpenFailure(address, sdkError());
  if (usbNode(address) && fault == DeviceFault::kWrongAddress) {
    fault = DeviceFault::kNoDevice;  // a USB camera that is not plugged in at present
  }
  throw DeviceError(fault, "There is no device '" + address + "'; " + listOf(devices));
}

std::string serialNumber(const openni::Device& device) {
  std::array<char, ONI_MAX_STR> text{};
  int size = static_cast<int>(text.size());
  if (device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, text.data(), &size) !=
      openni::STATUS_OK) {
    return {};
  }
  text.back() = '\0';
  return text.data();
}

}  // namespace mivo
