// SPDX-License-Identifier: BSD-3-Clause
// The text files of sequence folders: the first byte chooses which of them hold the rest.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fuzz/fuzz_file.h"
#include "io/sequence_layout.h"

namespace {

/// A folder in memory, removed at the end of the process.
class Folder {
 public:
  Folder() {
    std::string name = "/dev/shm/mivo-fuzz-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot create " + name);
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

constexpr std::array<const char*, 7> kNames = {
    "camera.txt",      "rgb.txt",        "depth.txt", "associations.txt",
    "calibration.txt", "associated.txt", "_info.txt"};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static const Folder folder;
  if (count == 0) return 0;
  // The files lie one behind the other, divided by zeros.
  const std::string text(reinterpret_cast<const char*>(bytes + 1), count - 1);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const std::filesystem::path path = folder.path() / kNames[i];
    std::filesystem::remove(path);
    if ((bytes[0] >> i & 1) == 0 || begin > text.size()) continue;
    const std::size_t end = std::min(text.find('\0', begin), text.size());
    std::ofstream(path, std::ios::binary) << text.substr(begin, end - begin);
    begin = end + 1;
  }
  mivo::expectErrorOrSuccess([&] { mivo::listSequence(folder.path().string()); });
  mivo::expectErrorOrSuccess([&] { mivo::readIntrinsics(folder.path() / "calibration.txt"); });
  return 0;
}
