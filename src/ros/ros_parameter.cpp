// SPDX-License-Identifier: BSD-3-Clause
#include "ros/ros_parameter.h"

#include <cmath>
#include <optional>
#include <sstream>

#include "core/plain_value.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

using Value = XmlRpc::XmlRpcValue;

[[noreturn]] void refuseType(const ros::NodeHandle& node, const std::string& name,
                             const Value& value, const char* expected) {
  throw Error("parameter '" + node.resolveName(name) + "' is " + typeText(value) + ", expected " +
              expected);
}

void checkRange(const ros::NodeHandle& node, const std::string& name, double value, double minimum,
                double maximum) {
  if (value >= minimum && value <= maximum) return;
  std::ostringstream text;
  text << "parameter '" << node.resolveName(name) << "': " << value << " is not from " << minimum
       << " to " << maximum;
  throw Error(text.str());
}

/// Also of a string that means one: YAML as rosparam reads it takes 1e-4 for a string.
std::optional<double> numberOf(Value& value) {
  if (value.getType() == Value::TypeInt) return static_cast<int&>(value);
  if (value.getType() == Value::TypeDouble) return static_cast<double&>(value);
  if (value.getType() == Value::TypeString) return parseNumber(static_cast<std::string&>(value));
  return std::nullopt;
}

}  // namespace

std::string typeText(const Value& value) {
  switch (value.getType()) {
    case Value::TypeBoolean:
      return "a switch (true or false)";
    case Value::TypeInt:
      return "a whole number";
    case Value::TypeDouble:
      return "a number with decimals";
    case Value::TypeString:
      return "a string";
    case Value::TypeArray:
      return "a list";
    case Value::TypeStruct:
      return "a group of parameters";
    default:
      return "of an unknown type";
  }
}

void readParameter(const ros::NodeHandle& node, const std::string& name, bool& value) {
  Value raw;
  if (!node.getParam(name, raw)) return;
  std::optional<bool> answer;
  if (raw.getType() == Value::TypeBoolean) answer = static_cast<bool&>(raw);
  if (raw.getType() == Value::TypeInt) answer = parseSwitch(std::to_string(static_cast<int&>(raw)));
  if (raw.getType() == Value::TypeString) answer = parseSwitch(static_cast<std::string&>(raw));
  if (!answer) refuseType(node, name, raw, "true or false");
  value = *answer;
}

void readParameter(const ros::NodeHandle& node, const std::string& name, std::string& value) {
  Value raw;
  if (!node.getParam(name, raw)) return;
  if (raw.getType() != Value::TypeString) refuseType(node, name, raw, "a string");
  value = static_cast<std::string&>(raw);
}

void readParameter(const ros::NodeHandle& node, const std::string& name, int& value, int minimum,
                   int maximum) {
  Value raw;
  if (!node.getParam(name, raw)) return;
  const std::optional<double> given = numberOf(raw);
  if (!given || *given != std::floor(*given)) refuseType(node, name, raw, "a whole number");
  checkRange(node, name, *given, static_cast<double>(minimum), static_cast<double>(maximum));
  value = static_cast<int>(*given);
}

void readParameter(const ros::NodeHandle& node, const std::string& name, double& value,
                   double minimum, double maximum) {
  Value raw;
  if (!node.getParam(name, raw)) return;
  const std::optional<double> number = numberOf(raw);
  if (!number) refuseType(node, name, raw, "a number");
  checkRange(node, name, *number, minimum, maximum);
  value = *number;
}

}  // namespace mivo
