// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace mivo {

/// Allocations by operator new, anywhere in this process, of the size of a color image's pixels.
constexpr std::size_t kCountedBytes = 640 * 480 * 3;

std::size_t countAllocations();

/// Whether one of the last 64 counted allocations gave this address: more than images are alive.
bool isRecentAllocation(const void* address);

}  // namespace mivo
