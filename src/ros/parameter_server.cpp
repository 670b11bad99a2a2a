// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameter_server.h"

#include <algorithm>
#include <limits>
#include <locale>
#include <sstream>

#include "core/nearest_name.h"
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

/// Value of a ROS parameter as the text that setParameter takes. roslaunch and rosparam read YAML
/// by rules of their own, by which 1e-4 is a string: what a string means is decided where the
/// values of configuration files are.
std::string valueText(const XmlRpc::XmlRpcValue& value, const std::string& name) {
  using Value = XmlRpc::XmlRpcValue;
  Value copy = value;  // the conversions of XmlRpcValue are not const everywhere
  switch (value.getType()) {
    case Value::TypeString:
      return static_cast<std::string&>(copy);
    case Value::TypeInt:
      return std::to_string(static_cast<int&>(copy));
    case Value::TypeDouble:
      return toText(static_cast<double&>(copy));
    case Value::TypeBoolean:
      return toText(static_cast<bool&>(copy));
    default:
      throw Error("parameter '" + name + "' is " + typeText(value) + ", expected a single value");
  }
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
    try {
      setParameter(parameters, info.name, valueText(value, node.resolveName(info.name)));
    } catch (const Error& error) {
      throw Error(node.getNamespace() + ": " + error.what());
    }
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
    faults.push_back("unknown parameter '" + full_name + "' has no effect" +
                     didYouMean(name, known));
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
