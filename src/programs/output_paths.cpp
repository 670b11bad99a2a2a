// SPDX-License-Identifier: BSD-3-Clause
#include "programs/output_paths.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "mivo/core/error.h"
#include "programs/command_line.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

/// Both name one file, though it may not exist yet. Devices may be named twice.
bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code error;  // what cannot be looked at is compared by its name
  if (fs::exists(a, error) && fs::exists(b, error)) {
    return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
  }
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a), error);
  const fs::path whole_b = fs::weakly_canonical(fs::absolute(b), error);
  return whole_a == whole_b;
}

void requireCreatable(const std::string& path) {
  std::error_code ignored;  // access() says why
  const bool exists = fs::exists(path, ignored);
  const fs::path parent = fs::absolute(path).parent_path();
  const int fault = exists ? access(path.c_str(), W_OK) : access(parent.c_str(), W_OK | X_OK);
  if (fault != 0) throw Error("cannot create " + path + ": " + std::strerror(errno));
  if (!exists && !fs::is_directory(parent)) {
    throw Error("cannot create " + path + ": " + parent.string() + " is no folder");
  }
}

}  // namespace

void requireOutputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs,
                    Overwrite overwrite) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    if (output.path.empty()) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (outputs[j].path.empty() || !isSameFile(outputs[j].path, output.path)) continue;
      throw UsageError(outputs[j].option + " and " + output.option + " name the same file");
    }
    for (const NamedFile& input : inputs) {
      if (input.path.empty() || !isSameFile(input.path, output.path)) continue;
      throw UsageError(output.option + " names " + input.option + ", which is read");
    }
  }
  for (const NamedFile& output : outputs) {
    if (output.path.empty()) continue;
    refuseExisting(output.path, overwrite);
    requireCreatable(output.path);
  }
}

}  // namespace mivo
