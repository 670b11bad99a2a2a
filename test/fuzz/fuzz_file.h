// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "mivo/core/error.h"

namespace mivo {

/// A file in memory, for readers that want a path.
class FuzzFile {
 public:
  FuzzFile() : descriptor_(memfd_create("fuzz", 0)) {
    if (descriptor_ < 0) throw std::runtime_error("no file in memory");
    path_ = "/proc/self/fd/" + std::to_string(descriptor_);
  }
  ~FuzzFile() { close(descriptor_); }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;

  /// The path of the file, which now holds these bytes.
  const std::string& holding(const std::uint8_t* bytes, std::size_t count) {
    if (ftruncate(descriptor_, 0) != 0 ||
        pwrite(descriptor_, bytes, count, 0) != static_cast<ssize_t>(count)) {
      throw std::runtime_error("cannot write a file in memory");
    }
    return path_;
  }

 private:
  int descriptor_;
  std::string path_;
};

/// Calls a reader: mivo's own Error is the answer to bad input, anything else ends the run.
template <typename Reader>
void expectErrorOrSuccess(const Reader& reader) {
  try {
    reader();
  } catch (const Error&) {
    return;
  }
}

}  // namespace mivo
