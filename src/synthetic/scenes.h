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

}  // namespace mivo
