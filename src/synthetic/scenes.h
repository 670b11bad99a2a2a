// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "synthetic/scene.h"

namespace mivo {

Scene makeBare(std::uint64_t seed);
Scene makeRoom(std::uint64_t seed);
Scene makeOffice(std::uint64_t seed);
Scene makeCorridor(std::uint64_t seed);
Scene makeWall(std::uint64_t seed);

// Of even colors with few edges: little texture, and some of it repeated.

/// A door, a picture, a standing lamp.
Scene makeHallway(std::uint64_t seed);
/// Seen from below: panels that repeat every 60 cm, lamps, an air outlet.
Scene makeCeiling(std::uint64_t seed);
/// A checkered wall above a row of cupboards: half a period away all edges fit.
Scene makePanels(std::uint64_t seed);
/// Walls beyond the depth sensor's range, the floor and two pillars within it.
Scene makeHall(std::uint64_t seed);
/// A white board with a few strokes.
Scene makeWhiteboard(std::uint64_t seed);

// One surface alone, evenly lit and without end, so that the image does not tell where on it the
// camera is. In each the camera is rolled: by the seed's remainder by three upright, by a quarter
// of a turn, or by any angle.

/// A wall with stripes: motion along them is open.
Scene makeStripes(std::uint64_t seed);
/// A wall of one color: all motion along it, and turning about its normal.
Scene makeBlank(std::uint64_t seed);
/// A tube seen from its axis, with stripes along it: motion along the axis is open.
Scene makeTube(std::uint64_t seed);
/// The same tube with rings around it: turning about the axis is open.
Scene makeRings(std::uint64_t seed);
/// A floor seen at an angle, with stripes or of one color.
Scene makeStripedFloor(std::uint64_t seed);
Scene makeBlankFloor(std::uint64_t seed);
/// A near wall with a picture where a path starts: the velocity is known when the view goes blind.
Scene makeStripesAfterTexture(std::uint64_t seed);
Scene makeBlankAfterTexture(std::uint64_t seed);

}  // namespace mivo
