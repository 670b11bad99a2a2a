// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OpenNI.h>

namespace mivo {

// Exposing color and depth together, by the camera's own property. Not by the SDK's
// setDepthColorSyncEnabled: with that on, starting or stopping a stream makes the SDK destroy the
// receiver of the other stream's images without synchronizing with the driver's thread, which may
// crash the process.

bool canSynchronize(const openni::Device& device);

/// For two streams that run; the camera forgets it when one of them starts or stops.
void synchronize(openni::Device& device, bool on);

}  // namespace mivo
