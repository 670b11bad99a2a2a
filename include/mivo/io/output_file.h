// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <fstream>
#include <string>

namespace mivo {

/// Whether a file that exists may be replaced.
enum class Overwrite { kNo, kYes };

/// Throws Error when `path` exists and may not be replaced, or is a folder.
void refuseExisting(const std::string& path, Overwrite overwrite);

/// A file that is flushed after each write, so that written data survives a later failure.
class OutputFile {
 public:
  /// Creates the file. Throws Error when it exists and may not be replaced, or cannot be created.
  OutputFile(const std::string& path, Overwrite overwrite);

  /// Appends and flushes. Throws Error when writing fails, for instance on a full disk.
  void write(const std::string& text);
  void write(const char* bytes, std::size_t count);

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::ofstream stream_;
};

}  // namespace mivo
