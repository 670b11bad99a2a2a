// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/config_file.h"

#include <yaml-cpp/yaml.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "mivo/core/error.h"

namespace mivo {
namespace {

[[noreturn]] void refuse(const std::string& path, const YAML::Mark& mark, const std::string& what) {
  throw Error(path + ":" + std::to_string(mark.line + 1) + ": " + what);
}

YAML::Node load(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw Error("cannot read " + path + ": it is a folder");
  errno = 0;
  std::ifstream stream(path);
  if (!stream) throw Error("cannot read " + path + ": " + std::strerror(errno));
  try {
    return YAML::Load(stream);
  } catch (const YAML::Exception& error) {
    refuse(path, error.mark, "no valid YAML: " + error.msg);
  }
}

}  // namespace

void readParameters(const std::string& path, Parameters& parameters) {
  const YAML::Node file = load(path);
  if (file.IsNull()) return;  // nothing but comments
  if (!file.IsMap()) refuse(path, file.Mark(), "expected lines 'name: value'");
  Parameters changed = parameters;
  std::set<std::string> names;
  for (const auto& entry : file) {
    const YAML::Mark mark = entry.first.Mark();
    if (!entry.first.IsScalar()) refuse(path, mark, "expected lines 'name: value'");
    const std::string& name = entry.first.Scalar();
    if (entry.second.IsNull()) refuse(path, mark, "'" + name + "' has no value");
    if (!entry.second.IsScalar()) {
      refuse(path, mark,
             "the value of '" + name + "' is not a single one; parameters are not nested");
    }
    if (!names.insert(name).second) refuse(path, mark, "'" + name + "' is given a second time");
    try {
      setParameter(changed, name, entry.second.Scalar());
    } catch (const Error& error) {
      refuse(path, mark, error.what());
    }
  }
  try {
    changed.validate();
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
  parameters = changed;
}

}  // namespace mivo
