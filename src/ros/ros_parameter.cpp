// SPDX-License-Identifier: BSD-3-Clause
#include "ros/ros_parameter.h"

#include <sstream>

#include "mivo/core/error.h"

namespace mivo {
namespace {

using Value = XmlRpc::XmlRpcValue;

[[noreturn]] void refuseType(const ros::NodeHandle& node, const std::string& name,
                             const Value& value, const char* expected) {
  throw Error("parameter '" + node.resolveName(name) + "' is " + typeText(value) + ", expected " +
              expected);
}

template <typename Number>
void checkRange(const ros::NodeHandle& node, const std::string& name, Number value, Number minimum,
                Number maximum) {
  if (value >= minimum && value <= maximum) return;
  std::ostringstream text;
  text << "parameter '" << node.resolveName(name) << "': " << value << " is not from " << minimum
       << " to " << maximum;
  throw Error(text.str());
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
  if (raw.getType() != Value::TypeBoolean) refuseType(node, name, raw, "true or false");
  value = static_cast<bool&>(raw);
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
  if (raw.getType() != Value::TypeInt) refuseType(node, name, raw, "a whole number");
  const int number = static_cast<int&>(raw);
  checkRange(node, name, number, minimum, maximum);
  value = number;
}

void readParameter(const ros::NodeHandle& node, const std::string& name, double& value,
                   double minimum, double maximum) {
  Value raw;
  if (!node.getParam(name, raw)) return;
  double number = 0.0;
  if (raw.getType() == Value::TypeInt) {
    number = static_cast<int&>(raw);
  } else if (raw.getType() == Value::TypeDouble) {
    number = static_cast<double&>(raw);
  } else {
    refuseType(node, name, raw, "a number");
  }
  checkRange(node, name, number, minimum, maximum);
  value = number;
}

}  // namespace mivo
