// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameter_server.h"

#include <algorithm>
#include <limits>
#include <locale>
#include <numeric>
#include <sstream>

#include "mivo/core/error.h"
#include "ros/ros_parameter.h"

namespace mivo {
namespace {

/// Text that reads back to the same number.
std::string toText(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  return text.str();
}

std::string toText(bool value) {
  return value ? "true" : "false";
}

/// Value of a ROS parameter as the text that setParameter takes. A string is passed on only to an
/// enumeration: "8" for a number is a mistake of the launch file that should be seen.
std::string valueText(const ParameterInfo& info, const XmlRpc::XmlRpcValue& value,
                      const std::string& name) {
  using Value = XmlRpc::XmlRpcValue;
  const bool enumeration = info.type == ParameterInfo::Type::kEnum;
  const bool number =
      info.type == ParameterInfo::Type::kInt || info.type == ParameterInfo::Type::kDouble;
  Value copy = value;  // the conversions of XmlRpcValue are not const everywhere
  if (value.getType() == Value::TypeString && enumeration) return static_cast<std::string&>(copy);
  if (value.getType() == Value::TypeInt && number) return std::to_string(static_cast<int&>(copy));
  if (value.getType() == Value::TypeDouble && number) return toText(static_cast<double&>(copy));
  if (value.getType() == Value::TypeBoolean && info.type == ParameterInfo::Type::kBool) {
    return toText(static_cast<bool&>(copy));
  }
  const char* const expected[] = {"a whole number", "a number", "true or false", "a word"};
  throw Error("parameter '" + name + "' is " + typeText(value) + ", expected " +
              expected[static_cast<int>(info.type)]);
}

/// Fewest insertions, deletions and replacements of a character that turn a into b.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

template <typename Entries>
void setAll(Parameters& parameters, const Entries& entries) {
  for (const auto& entry : entries) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(std::numeric_limits<double>::max_digits10);
    text << entry.value;
    setParameter(parameters, entry.name, text.str());
  }
}

template <typename Entry, typename Value>
void add(std::vector<Entry>& entries, const std::string& name, Value value) {
  Entry entry;
  entry.name = name;
  entry.value = value;
  entries.push_back(entry);
}

}  // namespace

Parameters readParameters(const ros::NodeHandle& node) {
  Parameters parameters;
  for (const ParameterInfo& info : parameterTable()) {
    XmlRpc::XmlRpcValue value;
    if (!node.getParam(info.name, value)) continue;
    setParameter(parameters, info.name, valueText(info, value, node.resolveName(info.name)));
  }
  parameters.validate();
  return parameters;
}

std::vector<std::string> findUnknownParameters(const ros::NodeHandle& node,
                                               const std::vector<std::string>& others) {
  std::vector<std::string> known = others;
  for (const ParameterInfo& info : parameterTable()) known.push_back(info.name);

  std::vector<std::string> all;
  node.getParamNames(all);
  const std::string prefix = node.getNamespace() + "/";
  std::vector<std::string> faults;
  for (const std::string& full_name : all) {
    if (full_name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string name = full_name.substr(prefix.size());
    if (name.find('/') != std::string::npos) continue;
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto nearest = std::min_element(known.begin(), known.end(),
                                          [&](const std::string& a, const std::string& b) {
                                            return editDistance(a, name) < editDistance(b, name);
                                          });
    faults.push_back("unknown parameter '" + full_name + "' has no effect; did you mean '" +
                     *nearest + "'?");
  }
  return faults;
}

void writeParameters(const ros::NodeHandle& node, const Parameters& parameters) {
  const dynamic_reconfigure::Config config = toConfig(parameters);
  for (const auto& entry : config.bools) node.setParam(entry.name, entry.value != 0);
  for (const auto& entry : config.ints) node.setParam(entry.name, entry.value);
  for (const auto& entry : config.doubles) node.setParam(entry.name, entry.value);
  for (const auto& entry : config.strs) node.setParam(entry.name, entry.value);
}

Parameters changed(const Parameters& parameters, const dynamic_reconfigure::Config& request) {
  Parameters result = parameters;
  for (const auto& entry : request.bools) {
    setParameter(result, entry.name, toText(entry.value != 0));
  }
  setAll(result, request.ints);
  setAll(result, request.doubles);
  setAll(result, request.strs);
  result.validate();
  return result;
}

dynamic_reconfigure::Config toConfig(const Parameters& parameters) {
  dynamic_reconfigure::Config config;
  for (const ParameterInfo& info : parameterTable()) {
    const std::string text = getParameter(parameters, info.name);
    switch (info.type) {
      case ParameterInfo::Type::kBool:
        add(config.bools, info.name, text == "true");
        break;
      case ParameterInfo::Type::kInt:
        add(config.ints, info.name, std::stoi(text));
        break;
      case ParameterInfo::Type::kDouble: {
        std::istringstream stream(text);
        stream.imbue(std::locale::classic());
        double value = 0.0;
        stream >> value;
        add(config.doubles, info.name, value);
        break;
      }
      case ParameterInfo::Type::kEnum:
        add(config.strs, info.name, text);
        break;
    }
  }
  dynamic_reconfigure::GroupState group;  // clients expect the group that all parameters are in
  group.name = "Default";
  group.state = true;
  config.groups.push_back(group);
  return config;
}

}  // namespace mivo
