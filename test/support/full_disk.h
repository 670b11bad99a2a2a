// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/resource.h>

#include <csignal>
#include <stdexcept>

namespace mivo {

/// While it lives, this process's files grow up to so many bytes, as if the disk were full there: a
/// write that goes beyond is cut off, the next one fails.
class FullDisk {
 public:
  explicit FullDisk(std::size_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);  // otherwise the process ends
    if (getrlimit(RLIMIT_FSIZE, &before_) != 0) throw std::runtime_error("no limit of files");
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) throw std::runtime_error("cannot limit files");
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

}  // namespace mivo
