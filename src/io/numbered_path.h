// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace mivo {

/// Where the trajectory goes on that begins when time was set back: name_2.txt after name.txt.
inline std::string numberedPath(const std::string& path, int number) {
  std::filesystem::path result = path;
  if (number > 1) {
    result.replace_filename(result.stem().string() + '_' + std::to_string(number) +
                            result.extension().string());
  }
  return result.string();
}

}  // namespace mivo
