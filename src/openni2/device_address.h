// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OpenNI.h>

#include <string>

#include "openni2/openni2_library.h"

namespace mivo {

/// Opens the device that DeviceRequest::address names. Throws DeviceError.
void openAddress(const OpenNi2Library& library, const std::string& address, openni::Device& device);

/// Empty when the device has none.
std::string serialNumber(const openni::Device& device);

}  // namespace mivo
