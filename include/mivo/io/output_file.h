// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace mivo {

/// Whether a file that exists may be replaced.
enum class Overwrite { kNo, kYes };

/// What a caller of a program can do about a file that exists.
constexpr const char* kForceOption = "choose another name, or --force to replace it";

/// Throws Error, which ends with `remedy`, when `path` exists and may not be replaced; also when it
/// is a folder.
void refuseExisting(const std::string& path, Overwrite overwrite,
                    const char* remedy = kForceOption);

/// A file written piece by piece. A piece is with the system when `write` returns: neither the end
/// of the process nor a full disk takes it back.
class OutputFile {
 public:
  /// Creates the file. Throws Error when it exists and may not be replaced, or cannot be created.
  OutputFile(const std::string& path, Overwrite overwrite);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends all of it, or nothing: throws Error when that fails, for instance on a full disk. The
  /// next call tries again.
  void write(const std::string& text);
  void write(const char* bytes, std::size_t count);

  const std::string& path() const { return path_; }

 private:
  void takeBack(std::size_t count);

  std::string path_;
  int descriptor_;
};

}  // namespace mivo
