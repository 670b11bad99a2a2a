// SPDX-License-Identifier: BSD-3-Clause
#include "support/heap_counter.h"

#include <cerrno>

// glibc keeps its functions under these names for those who replace the public ones.
extern "C" {
void* __libc_malloc(std::size_t size);                     // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t count, std::size_t size);  // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* old, std::size_t size);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t alignment,
                      std::size_t size);  // NOLINT(bugprone-reserved-identifier)
}

namespace {

thread_local std::size_t num_allocations = 0;

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept {
  ++num_allocations;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  ++num_allocations;
  return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) noexcept {
  ++num_allocations;
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  ++num_allocations;
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}

int posix_memalign(void** address, std::size_t alignment, std::size_t size) noexcept {
  *address = memalign(alignment, size);
  return *address == nullptr ? ENOMEM : 0;
}
}

namespace mivo::testing {

std::size_t numAllocations() {
  return num_allocations;
}

}  // namespace mivo::testing
