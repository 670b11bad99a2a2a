// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "synthetic/scene_builder.h"

// Common part of the scenes of one surface.

namespace mivo {

/// Material that is lit evenly and has no stains.
int evenMaterial(SceneBuilder& builder, Texture texture);
/// Pale paint without any structure.
int evenPaint(SceneBuilder& builder);
/// Lamps out of sight; the light that they are said to give is everywhere.
void hideLamps(Scene& scene);
/// Upright, by a quarter of a turn, or any angle (rad), by the seed's remainder by three.
double rollOfSeed(std::uint64_t seed);

}  // namespace mivo
