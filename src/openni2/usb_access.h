// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "openni2/device_error.h"

namespace mivo {

/// The device node of an URI of libOpenNI2's USB drivers ("1d27/0601@1/5" is bus 1, address 5:
/// ROOT/001/005). Nothing for any other URI.
std::optional<std::string> usbNode(const std::string& uri,
                                   const std::string& root = "/dev/bus/usb");

/// Whether this process may read and write the node; true when it does not exist.
bool mayUse(const std::string& node);

/// Classifies a failure to open: by the permissions of the node, then by the SDK's text.
DeviceFault classifyOpenFailure(const std::string& uri, const std::string& sdk_text,
                                const std::string& usb_root = "/dev/bus/usb");

}  // namespace mivo
