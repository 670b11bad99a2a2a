// SPDX-License-Identifier: BSD-3-Clause
// The parts that need no ROS master; reading from the server is part of odometry_rostest.
#include "ros/parameter_server.h"

#include <gtest/gtest.h>
#include <mivo/OdometryConfig.h>

#include <map>
#include <sstream>

#include "ros/expect_error.h"

namespace mivo {
namespace {

dynamic_reconfigure::DoubleParameter number(const std::string& name, double value) {
  dynamic_reconfigure::DoubleParameter parameter;
  parameter.name = name;
  parameter.value = value;
  return parameter;
}

dynamic_reconfigure::IntParameter whole(const std::string& name, int value) {
  dynamic_reconfigure::IntParameter parameter;
  parameter.name = name;
  parameter.value = value;
  return parameter;
}

dynamic_reconfigure::StrParameter word(const std::string& name, const std::string& value) {
  dynamic_reconfigure::StrParameter parameter;
  parameter.name = name;
  parameter.value = value;
  return parameter;
}

TEST(ChangedTest, TakesAllKindsOfValues) {
  dynamic_reconfigure::Config request;
  request.doubles.push_back(number("min_depth", 0.1 + 0.2));
  request.ints.push_back(whole("mi_bins", 16));
  request.strs.push_back(word("method", "ssd"));
  const Parameters parameters = changed(Parameters(), request);
  EXPECT_EQ(0.1 + 0.2, parameters.depth.min_depth);  // to the bit
  EXPECT_EQ(16, parameters.mi.mi_bins);
  EXPECT_EQ(Method::kSsd, parameters.alignment.method);
}

TEST(ChangedTest, RefusesTheWholeRequest) {
  dynamic_reconfigure::Config request;
  request.ints.push_back(whole("mi_bins", 16));
  request.ints.push_back(whole("levels", 99));
  EXPECT_ERROR(changed(Parameters(), request), "levels");
  request.ints.back() = whole("mi_binz", 9);
  EXPECT_ERROR(changed(Parameters(), request), "mi_bins");
  request.ints.pop_back();
  request.strs.push_back(word("method", "features"));
  EXPECT_ERROR(changed(Parameters(), request), "ssd mi hybrid");
}

TEST(ChangedTest, RefusesValuesThatContradictEachOther) {
  dynamic_reconfigure::Config request;
  request.doubles.push_back(number("min_depth", 5.0));
  request.doubles.push_back(number("max_depth", 4.0));
  EXPECT_ERROR(changed(Parameters(), request), "min_depth");
}

TEST(ToConfigTest, ComesBackTheSame) {
  Parameters parameters;
  parameters.depth.min_depth = 0.1 + 0.2;
  parameters.alignment.method = Method::kMi;
  const Parameters back = changed(Parameters(), toConfig(parameters));
  for (const ParameterInfo& info : parameterTable()) {
    EXPECT_EQ(getParameter(parameters, info.name), getParameter(back, info.name)) << info.name;
  }
}

/// The text that Odometry.cfg generates from the table.
std::map<std::string, std::string> valuesOf(const dynamic_reconfigure::Config& config) {
  std::map<std::string, std::string> values;
  for (const auto& entry : config.bools) values[entry.name] = entry.value ? "true" : "false";
  for (const auto& entry : config.ints) values[entry.name] = std::to_string(entry.value);
  for (const auto& entry : config.strs) values[entry.name] = entry.value;
  for (const auto& entry : config.doubles) {
    std::ostringstream text;
    text.precision(17);
    text << entry.value;
    values[entry.name] = text.str();
  }
  return values;
}

TEST(OdometryConfigTest, HasTheNamesDefaultsRangesAndTextsOfTheTable) {
  const dynamic_reconfigure::ConfigDescription description =
      OdometryConfig::__getDescriptionMessage__();
  const auto defaults = valuesOf(description.dflt);
  const auto minima = valuesOf(description.min);
  const auto maxima = valuesOf(description.max);
  ASSERT_EQ(parameterTable().size(), defaults.size());
  std::map<std::string, dynamic_reconfigure::ParamDescription> described;
  for (const auto& group : description.groups) {
    for (const auto& parameter : group.parameters) described[parameter.name] = parameter;
  }
  for (const ParameterInfo& info : parameterTable()) {
    ASSERT_EQ(1U, defaults.count(info.name)) << info.name;
    Parameters parameters;
    setParameter(parameters, info.name, defaults.at(info.name));
    EXPECT_EQ(info.default_value, getParameter(parameters, info.name)) << info.name;
    const auto& parameter = described.at(info.name);
    EXPECT_EQ(0U, parameter.description.find(info.text)) << info.name;
    if (info.type == ParameterInfo::Type::kInt || info.type == ParameterInfo::Type::kDouble) {
      EXPECT_EQ(info.minimum, std::stod(minima.at(info.name))) << info.name;
      EXPECT_EQ(info.maximum, std::stod(maxima.at(info.name))) << info.name;
    }
    for (const std::string& choice : info.words) {
      EXPECT_NE(std::string::npos, parameter.edit_method.find("'" + choice + "'")) << info.name;
    }
  }
}

}  // namespace
}  // namespace mivo
