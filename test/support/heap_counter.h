// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace mivo::testing {

/// Number of heap allocations of the calling thread so far, by new, malloc and related functions,
/// and thus also by OpenCV's matrices. Linking heap_counter.cpp replaces glibc's functions.
std::size_t numAllocations();

}  // namespace mivo::testing
