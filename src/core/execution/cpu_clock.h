// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace mivo {

/// Processor time by one of the system's clocks, milliseconds.
inline double clockMilliseconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Processor time of the calling thread, milliseconds.
inline double threadMilliseconds() {
  return clockMilliseconds(CLOCK_THREAD_CPUTIME_ID);
}

/// Processor time of all threads of the process, milliseconds.
inline double processMilliseconds() {
  return clockMilliseconds(CLOCK_PROCESS_CPUTIME_ID);
}

}  // namespace mivo
