// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/frame_sync.h"

#include <PS1080.h>

#include <cstdint>

namespace mivo {

bool canSynchronize(const openni::Device& device) {
  return device.isPropertySupported(XN_MODULE_PROPERTY_FIRMWARE_FRAME_SYNC);
}

void synchronize(openni::Device& device, bool on) {
  // A refusal shows in the pairing offset of the diagnostics.
  device.setProperty<std::uint64_t>(XN_MODULE_PROPERTY_FIRMWARE_FRAME_SYNC, on ? 1 : 0);
}

}  // namespace mivo
