// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OpenNI.h>

namespace mivo {

// Exposing colour and depth together, by the camera's own property. Not by the SDK's
// setDepthColorSyncEnabled: with that on, whenever a stream starts or stops the SDK destroys what
// images of the other stream are handed to, and does not look whether the driver's thread is about
// to hand one over. Then the process ends.

bool canSynchronise(const openni::Device& device);

/// For two streams that run; the camera forgets it when one of them starts or stops.
void synchronise(openni::Device& device, bool on);

}  // namespace mivo
