// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace mivo {

/// Processor time of the calling thread, milliseconds.
inline double threadMilliseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace mivo
