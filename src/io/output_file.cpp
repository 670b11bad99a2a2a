// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "mivo/core/error.h"

namespace mivo {

namespace fs = std::filesystem;

void refuseExisting(const std::string& path, Overwrite overwrite, const char* remedy) {
  std::error_code
      ignored;  // what cannot be looked at will fail, with its reason, when it is created
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) throw Error("cannot write " + path + ": it is a folder");
  if (overwrite == Overwrite::kNo && fs::exists(status)) {
    throw Error(path + " exists: " + remedy);
  }
}

OutputFile::OutputFile(const std::string& path, Overwrite overwrite) : path_(path) {
  constexpr int kPermissions = 0666;  // less those of the umask
  refuseExisting(path, overwrite);
  descriptor_ = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kPermissions);
  if (descriptor_ < 0) throw Error("cannot create " + path + ": " + std::strerror(errno));
}

OutputFile::~OutputFile() {
  close(descriptor_);
}

void OutputFile::write(const std::string& text) {
  write(text.data(), text.size());
}

void OutputFile::write(const char* bytes, std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t written = ::write(descriptor_, bytes + done, count - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      takeBack(done);
      throw Error("cannot write " + path_ + ": " + std::strerror(reason));
    }
    done += static_cast<std::size_t>(written);
  }
}

/// Half a record would make the whole file unreadable. Of a pipe nothing can be taken back.
void OutputFile::takeBack(std::size_t count) {
  const off_t end = count == 0 ? -1 : lseek(descriptor_, -static_cast<off_t>(count), SEEK_CUR);
  if (end >= 0 && ftruncate(descriptor_, end) != 0) lseek(descriptor_, 0, SEEK_END);
}

}  // namespace mivo
