// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace mivo::testing {

/// What a process holds.
struct Holdings {
  int threads = 0;
  int descriptors = 0;       ///< files, sockets
  double resident_mb = 0.0;  ///< memory
};

inline int numEntries(const std::filesystem::path& folder) {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

inline Holdings holdingsOf(pid_t process) {
  const std::filesystem::path folder = "/proc/" + std::to_string(process);
  Holdings holdings;
  holdings.threads = numEntries(folder / "task");
  holdings.descriptors = numEntries(folder / "fd");
  std::ifstream file(folder / "statm");
  double pages = 0.0;
  double resident_pages = 0.0;
  if (!(file >> pages >> resident_pages)) throw std::runtime_error("no " + folder.string());
  holdings.resident_mb = resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
  return holdings;
}

/// A number from the environment, for runs that are longer than those of the suite.
inline int fromEnvironment(const char* name, int usual) {
  const char* text = std::getenv(name);
  return text == nullptr ? usual : std::stoi(text);
}

}  // namespace mivo::testing
