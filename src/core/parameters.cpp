// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/parameters.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <locale>
#include <sstream>

#include "core/nearest_name.h"
#include "core/plain_value.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr Update live = Update::kLive;          // the words of parameters.def
constexpr Update keyframe = Update::kKeyframe;  // NOLINT(readability-identifier-naming)

std::vector<std::string> split(const std::string& words) {
  std::vector<std::string> result;
  std::istringstream stream(words);
  for (std::string word; std::getline(stream, word, '|');) result.push_back(word);
  return result;
}

/// Shortest decimal text that reads back to the same number.
std::string toText(double value) {
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(digits);
    stream << value;
    if (std::strtod(stream.str().c_str(), nullptr) == value) return stream.str();
  }
  return "nan";
}

std::string toText(int value) {
  return std::to_string(value);
}
std::string toText(bool value) {
  return value ? "true" : "false";
}

std::string rangeText(const ParameterInfo& info) {
  if (info.type == ParameterInfo::Type::kBool) return "true or false";
  if (info.type == ParameterInfo::Type::kEnum) {
    std::string text = "one of";
    for (const std::string& word : info.words) text += ' ' + word;
    return text;
  }
  const bool integer = info.type == ParameterInfo::Type::kInt;
  return std::string(integer ? "a whole number" : "a number") + " from " + toText(info.minimum) +
         " to " + toText(info.maximum) + ' ' + info.unit;
}

[[noreturn]] void refuse(const ParameterInfo& info, const std::string& value) {
  throw Error("parameter '" + info.name + "': '" + value + "' is not " + rangeText(info));
}

double numberOf(const ParameterInfo& info, const std::string& value) {
  const std::optional<double> number = parseNumber(value);
  if (!number || !(*number >= info.minimum && *number <= info.maximum)) refuse(info, value);
  return *number;
}

void parse(const ParameterInfo& info, const std::string& value, double& target) {
  target = numberOf(info, value);
}

void parse(const ParameterInfo& info, const std::string& value, int& target) {
  const double number = numberOf(info, value);
  if (number != std::floor(number)) refuse(info, value);
  target = static_cast<int>(number);
}

[[maybe_unused]] void parse(const ParameterInfo& info, const std::string& value, bool& target) {
  const std::optional<bool> answer = parseSwitch(value);
  if (!answer) refuse(info, value);
  target = *answer;
}

template <typename Enum>
void parse(const ParameterInfo& info, const std::string& value, Enum& target) {
  const auto word = std::find(info.words.begin(), info.words.end(), value);
  if (word == info.words.end()) refuse(info, value);
  target = static_cast<Enum>(word - info.words.begin());
}

template <typename Enum>
std::string printEnum(const ParameterInfo& info, Enum value) {
  const auto index = static_cast<std::size_t>(value);
  return index < info.words.size() ? info.words[index] : std::string("?");
}

const ParameterInfo& find(const std::string& name) {
  std::vector<std::string> known;
  for (const ParameterInfo& info : parameterTable()) {
    if (info.name == name) return info;
    known.push_back(info.name);
  }
  throw Error("unknown parameter '" + name + "'" + didYouMean(name, known));
}

std::vector<ParameterInfo> makeTable() {
  using Type = ParameterInfo::Type;
  const Parameters all;
  std::vector<ParameterInfo> table;
#define MIVO_GROUP(Struct, member, title) \
  {                                       \
    const Struct& defaults = all.member;  \
    const std::string group = title;
#define MIVO_GROUP_END(Struct, member) }
#define MIVO_INT(name, value, minimum, maximum, unit, update, text) \
  table.push_back({group,                                           \
                   #name,                                           \
                   Type::kInt,                                      \
                   toText(defaults.name),                           \
                   minimum,                                         \
                   maximum,                                         \
                   {},                                              \
                   unit,                                            \
                   update,                                          \
                   text});
#define MIVO_DOUBLE(name, value, minimum, maximum, unit, update, text) \
  table.push_back({group,                                              \
                   #name,                                              \
                   Type::kDouble,                                      \
                   toText(defaults.name),                              \
                   minimum,                                            \
                   maximum,                                            \
                   {},                                                 \
                   unit,                                               \
                   update,                                             \
                   text});
#define MIVO_BOOL(name, value, update, text) \
  table.push_back(                           \
      {group, #name, Type::kBool, toText(defaults.name), 0.0, 1.0, {}, "", update, text});
#define MIVO_ENUM(EnumType, name, value, choices, update, text)                                 \
  table.push_back({group, #name, Type::kEnum, "", 0.0, 0.0, split(choices), "", update, text}); \
  table.back().default_value = printEnum(table.back(), defaults.name);
#include "mivo/core/parameters.def"
#undef MIVO_GROUP
#undef MIVO_GROUP_END
#undef MIVO_INT
#undef MIVO_DOUBLE
#undef MIVO_BOOL
#undef MIVO_ENUM
  return table;
}

/// Calls visit(info, value) with a reference to each value of the parameters, in table order.
template <typename ParametersType, typename Visitor>
void visit(ParametersType& parameters, Visitor&& visitor) {
  std::size_t row = 0;
  const std::vector<ParameterInfo>& table = parameterTable();
#define MIVO_GROUP(Struct, member, title) \
  {                                       \
    auto& group = parameters.member;
#define MIVO_GROUP_END(Struct, member) }
#define MIVO_INT(name, ...) visitor(table[row++], group.name);
#define MIVO_DOUBLE(name, ...) visitor(table[row++], group.name);
#define MIVO_BOOL(name, ...) visitor(table[row++], group.name);
#define MIVO_ENUM(Type, name, ...) visitor(table[row++], group.name);
#include "mivo/core/parameters.def"
#undef MIVO_GROUP
#undef MIVO_GROUP_END
#undef MIVO_INT
#undef MIVO_DOUBLE
#undef MIVO_BOOL
#undef MIVO_ENUM
}

std::string valueText(const ParameterInfo&, int value) {
  return toText(value);
}
std::string valueText(const ParameterInfo&, double value) {
  return toText(value);
}
[[maybe_unused]] std::string valueText(const ParameterInfo&, bool value) {
  return toText(value);
}
template <typename Enum>
std::string valueText(const ParameterInfo& info, Enum value) {
  return printEnum(info, value);
}

}  // namespace

const std::vector<ParameterInfo>& parameterTable() {
  static const std::vector<ParameterInfo> table = makeTable();
  return table;
}

void setParameter(Parameters& parameters, const std::string& name, const std::string& value) {
  const ParameterInfo& wanted = find(name);
  visit(parameters, [&](const ParameterInfo& info, auto& target) {
    if (&info == &wanted) parse(info, value, target);
  });
}

std::string getParameter(const Parameters& parameters, const std::string& name) {
  const ParameterInfo& wanted = find(name);
  std::string text;
  visit(parameters, [&](const ParameterInfo& info, const auto& value) {
    if (&info == &wanted) text = valueText(info, value);
  });
  return text;
}

bool actWithKeyframe(const Parameters& before, const Parameters& after) {
  return std::any_of(parameterTable().begin(), parameterTable().end(),
                     [&](const ParameterInfo& info) {
                       return info.update == Update::kKeyframe &&
                              getParameter(before, info.name) != getParameter(after, info.name);
                     });
}

Parameters withLiveParameters(const Parameters& before, const Parameters& after) {
  Parameters result = before;
  for (const ParameterInfo& info : parameterTable()) {
    if (info.update == Update::kLive)
      setParameter(result, info.name, getParameter(after, info.name));
  }
  return result;
}

void Parameters::validate() const {
  Parameters scratch;
  for (const ParameterInfo& info : parameterTable()) {
    setParameter(scratch, info.name, getParameter(*this, info.name));
  }
  if (depth.min_depth >= depth.max_depth) {
    throw Error("parameter 'min_depth': " + toText(depth.min_depth) +
                " m is not below max_depth, " + toText(depth.max_depth) + " m");
  }
}

}  // namespace mivo
