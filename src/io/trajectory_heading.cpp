// SPDX-License-Identifier: BSD-3-Clause
#include "io/trajectory_heading.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace mivo {
namespace {

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// In small letters, without units in brackets and blanks: "p_RS_R_x [m]" is "p_rs_r_x".
std::string simplified(const std::string& name) {
  std::string result;
  for (const char character : name.substr(0, name.find('['))) {
    if (std::isspace(static_cast<unsigned char>(character)) != 0) continue;
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  }
  return result;
}

/// Columns are separated by commas where the line has some: their names have blanks then.
std::vector<std::string> namesOf(const std::string& line) {
  const char* const separators = contains(line, ",") ? "," : contains(line, ";") ? ";" : " \t";
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    const std::string name = simplified(line.substr(begin, end - begin));
    if (!name.empty()) names.push_back(name);
    begin = end + 1;
  }
  return names;
}

enum class Kind { kOther, kStamp, kNanoseconds, kPosition, kQuaternion };

Kind kindOf(const std::string& name) {
  for (const char* other : {"vel", "twist", "linear", "angular", "accel", "cov", "bias", "seq"}) {
    if (contains(name, other)) return Kind::kOther;
  }
  if (contains(name, "nsec") || contains(name, "nanosec")) return Kind::kNanoseconds;
  if (contains(name, "time") || contains(name, "stamp") || name == "t") return Kind::kStamp;
  const bool is_axis = name.back() >= 'x' && name.back() <= 'z';
  if (contains(name, "orientation") || contains(name, "quat") || name.front() == 'q') {
    return is_axis || name.back() == 'w' ? Kind::kQuaternion : Kind::kOther;
  }
  const bool is_position = name.size() == 1 || contains(name, "pos") || contains(name, "trans") ||
                           name.front() == 't' || name.front() == 'p';
  return is_axis && is_position ? Kind::kPosition : Kind::kOther;
}

}  // namespace

std::optional<PoseColumns> parseHeading(const std::string& line) {
  constexpr std::size_t kMissing = static_cast<std::size_t>(-1);
  const std::vector<std::string> names = namesOf(line);
  PoseColumns columns;
  columns.count = names.size();
  columns.stamp = kMissing;
  columns.position.fill(kMissing);
  columns.quaternion.fill(kMissing);
  const auto take = [](std::size_t& column, std::size_t i) {
    if (column == kMissing) column = i;  // the first of several
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Kind kind = kindOf(names[i]);
    const std::size_t axis = names[i].back() == 'w' ? 3U : std::size_t(names[i].back() - 'x');
    if (kind == Kind::kStamp) take(columns.stamp, i);
    if (kind == Kind::kNanoseconds && !columns.nanoseconds) columns.nanoseconds = i;
    if (kind == Kind::kPosition) take(columns.position[axis], i);
    if (kind == Kind::kQuaternion) take(columns.quaternion[axis], i);
  }
  const auto is_missing = [](std::size_t column) { return column == kMissing; };
  if (is_missing(columns.stamp) ||
      std::any_of(columns.position.begin(), columns.position.end(), is_missing) ||
      std::any_of(columns.quaternion.begin(), columns.quaternion.end(), is_missing)) {
    return std::nullopt;
  }
  return columns;
}

}  // namespace mivo
