// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "mivo/core/error.h"

namespace mivo {

namespace fs = std::filesystem;

void refuseExisting(const std::string& path, Overwrite overwrite) {
  std::error_code
      ignored;  // what cannot be looked at will fail, with its reason, when it is created
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) throw Error("cannot write " + path + ": it is a folder");
  if (overwrite == Overwrite::kNo && fs::exists(status)) {
    throw Error(path + " exists: choose another name, or --force to replace it");
  }
}

OutputFile::OutputFile(const std::string& path, Overwrite overwrite) : path_(path) {
  refuseExisting(path, overwrite);
  errno = 0;
  stream_.open(path, std::ios::binary | std::ios::trunc);
  if (!stream_) throw Error("cannot create " + path + ": " + std::strerror(errno));
}

void OutputFile::write(const std::string& text) {
  write(text.data(), text.size());
}

void OutputFile::write(const char* bytes, std::size_t count) {
  errno = 0;
  stream_.write(bytes, static_cast<std::streamsize>(count));
  stream_.flush();
  if (!stream_) throw Error("cannot write " + path_ + ": " + std::strerror(errno));
}

}  // namespace mivo
