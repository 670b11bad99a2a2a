// SPDX-License-Identifier: BSD-3-Clause
#include "control_file.h"

#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

namespace virtual_xtion {
namespace {

template <typename Value>
std::function<void(Control&, std::istream&)> field(Value Control::*member) {
  return [member](Control& control, std::istream& in) { in >> control.*member; };
}

const std::map<std::string, std::function<void(Control&, std::istream&)>>& fields() {
  static const std::map<std::string, std::function<void(Control&, std::istream&)>> table{
      {"folder", field(&Control::folder)},
      {"truth", field(&Control::truth)},
      {"decode_first", field(&Control::decode_first)},
      {"devices", field(&Control::devices)},
      {"present", field(&Control::present)},
      {"in_use", field(&Control::in_use)},
      {"no_permission", field(&Control::no_permission)},
      {"color", field(&Control::color)},
      {"registration", field(&Control::registration)},
      {"settings", field(&Control::settings)},
      {"deaf", field(&Control::deaf)},
      {"until", field(&Control::until)},
      {"pace", field(&Control::pace)},
      {"rate", field(&Control::rate)},
      {"drop_every", field(&Control::drop_every)},
      {"color_stalls", field(&Control::color_stalls)},
      {"depth_stalls", field(&Control::depth_stalls)},
      {"depth_delay", field(&Control::depth_delay)},
      {"jitter", field(&Control::jitter)},
      {"clock_ppm", field(&Control::clock_ppm)}};
  return table;
}

}  // namespace

Control readControl(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  Control control;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream in(line);
    std::string name;
    if (!(in >> name)) {
      continue;
    }
    const auto found = fields().find(name);
    if (found != fields().end()) {
      found->second(control, in);
    }
    if (found == fields().end() || !in) {
      throw std::runtime_error(path + ": cannot understand '" + line + "'");
    }
  }
  return control;
}

std::string controlPath() {
  const char* path = std::getenv("MIVO_VIRTUAL_XTION");
  return path == nullptr ? "" : path;
}

}  // namespace virtual_xtion
