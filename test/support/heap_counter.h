// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace mivo::testing {

/// Allocations on the heap by the calling thread so far, whoever asked for them: new, malloc and
/// its kin, and therefore OpenCV's matrices too. Linking heap_counter.cpp replaces glibc's
/// functions.
std::size_t numAllocations();

}  // namespace mivo::testing
