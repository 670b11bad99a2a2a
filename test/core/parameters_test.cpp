// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/parameters.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <set>
#include <string>

#include "mivo/core/error.h"

namespace mivo {
namespace {

using Type = ParameterInfo::Type;

/// The text of the Error that setting a parameter throws; empty when it throws none.
std::string refusal(const std::string& name, const std::string& value) {
  Parameters parameters;
  try {
    setParameter(parameters, name, value);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(ParameterTableTest, EveryRowIsComplete) {
  std::set<std::string> names;
  for (const ParameterInfo& info : parameterTable()) {
    SCOPED_TRACE(info.name);
    EXPECT_TRUE(names.insert(info.name).second) << "twice";
    EXPECT_EQ(info.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
              std::string::npos);
    EXPECT_FALSE(info.group.empty());
    EXPECT_GT(info.text.size(), 20U);
    EXPECT_TRUE(info.text.back() == '.' || info.text.back() == ')') << info.text;
    EXPECT_EQ(info.text.find('\n'), std::string::npos);
    const bool is_number = info.type == Type::kInt || info.type == Type::kDouble;
    EXPECT_EQ(is_number, !info.unit.empty());
    EXPECT_EQ(info.type == Type::kEnum, info.words.size() > 1);
    if (is_number) {
      const double value = std::stod(info.default_value);
      EXPECT_LT(info.minimum, info.maximum);
      EXPECT_GE(value, info.minimum);
      EXPECT_LE(value, info.maximum);
    }
  }
  EXPECT_GT(names.size(), 30U);
}

TEST(ParameterTableTest, NamesThatOthersScriptAgainstAreThere) {
  Parameters parameters;
  for (const char* name :
       {"method", "levels", "switch_level", "mi_bins", "mi_hessian", "robust_weight", "min_depth",
        "max_depth", "max_iterations", "keyframe_policy", "threads", "motion_model"}) {
    EXPECT_NO_THROW(getParameter(parameters, name)) << name;
  }
}

TEST(ParametersTest, DefaultsAreValid) {
  EXPECT_NO_THROW(Parameters().validate());
}

TEST(ParametersTest, EveryValueReadsBackAsItWasWritten) {
  for (const ParameterInfo& info : parameterTable()) {
    SCOPED_TRACE(info.name);
    std::vector<std::string> values = info.words;
    if (info.type == Type::kBool) values = {"true", "false"};
    if (info.type == Type::kInt) {
      values = {std::to_string(static_cast<int>(info.minimum)),
                std::to_string(static_cast<int>(info.maximum))};
    }
    if (info.type == Type::kDouble) {
      Parameters parameters;
      for (const double part : {0.0, 1.0 / 3.0, 0.1, 1.0}) {
        const double value = info.minimum + part * (info.maximum - info.minimum);
        char text[40];
        std::snprintf(text, sizeof text, "%.17g", value);
        setParameter(parameters, info.name, text);
        EXPECT_EQ(std::stod(getParameter(parameters, info.name)), value);
      }
      continue;
    }
    for (const std::string& value : values) {
      Parameters parameters;
      setParameter(parameters, info.name, value);
      EXPECT_EQ(getParameter(parameters, info.name), value);
      for (const ParameterInfo& other : parameterTable()) {
        if (other.name != info.name) {
          EXPECT_EQ(getParameter(parameters, other.name), other.default_value);
        }
      }
    }
  }
}

TEST(ParametersTest, TheFieldOfTheStructIsWhatIsSet) {
  Parameters parameters;
  setParameter(parameters, "method", "mi");
  setParameter(parameters, "mi_bins", "16");
  setParameter(parameters, "min_depth", "0.75");
  setParameter(parameters, "robust_weight", "student_t");
  setParameter(parameters, "keyframe_policy", "first");
  setParameter(parameters, "motion_model", "constant_pose");
  setParameter(parameters, "mi_hessian", "reference");
  EXPECT_EQ(parameters.alignment.method, Method::kMi);
  EXPECT_EQ(parameters.mi.mi_bins, 16);
  EXPECT_EQ(parameters.depth.min_depth, 0.75);
  EXPECT_EQ(parameters.ssd.robust_weight, RobustWeight::kStudentT);
  EXPECT_EQ(parameters.keyframes.keyframe_policy, KeyframePolicy::kFirst);
  EXPECT_EQ(parameters.motion.motion_model, MotionModelKind::kConstantPose);
  EXPECT_EQ(parameters.mi.mi_hessian, MiHessian::kReference);
}

TEST(ParametersTest, AnUnknownNameIsAnsweredWithTheNearestOne) {
  EXPECT_TRUE(contains(refusal("mi_bin", "8"), "'mi_bins'"));
  EXPECT_TRUE(contains(refusal("keyfram_rotation", "0.1"), "'keyframe_rotation'"));
  EXPECT_TRUE(contains(refusal("keyfram_rotation", "0.1"), "keyfram_rotation"));
  EXPECT_TRUE(contains(refusal("switch-level", "1"), "'switch_level'"));
  EXPECT_TRUE(contains(refusal("", "1"), "unknown"));
  EXPECT_THROW(getParameter(Parameters(), "no_such_thing"), Error);
}

TEST(ParametersTest, OutOfRangeNamesNameValueRangeAndUnit) {
  for (const ParameterInfo& info : parameterTable()) {
    if (info.type != Type::kInt && info.type != Type::kDouble) continue;
    SCOPED_TRACE(info.name);
    for (const double value : {info.minimum - 1.0, info.maximum + 1.0}) {
      const std::string text = refusal(info.name, std::to_string(value));
      EXPECT_TRUE(contains(text, info.name)) << text;
      EXPECT_TRUE(contains(text, std::to_string(value))) << text;
      EXPECT_TRUE(contains(text, info.unit)) << text;
      EXPECT_TRUE(contains(text, " to ")) << text;
    }
  }
}

TEST(ParametersTest, WhatIsNoNumberIsRefused) {
  for (const char* value : {"", "eight", "8 bins", "nan", "inf", "8,5", "0x10", "--8", "1e"}) {
    EXPECT_FALSE(refusal("mi_bins", value).empty()) << value;
    EXPECT_FALSE(refusal("min_depth", value).empty()) << value;
  }
  EXPECT_FALSE(refusal("mi_bins", "8.5").empty());
  EXPECT_TRUE(refusal("mi_bins", " 8 ").empty());
  EXPECT_TRUE(refusal("mi_bins", "8.0").empty());
}

TEST(ParametersTest, AWrongWordIsAnsweredWithTheRightOnes) {
  const std::string text = refusal("method", "MI");
  EXPECT_TRUE(contains(text, "ssd mi hybrid")) << text;
  EXPECT_FALSE(refusal("robust_weight", "1").empty());
}

TEST(ParametersTest, ARefusedValueChangesNothing) {
  Parameters parameters;
  parameters.mi.mi_bins = 12;
  EXPECT_THROW(setParameter(parameters, "mi_bins", "1000"), Error);
  EXPECT_EQ(parameters.mi.mi_bins, 12);
}

TEST(ParametersTest, ValidateNamesTheField) {
  Parameters parameters;
  parameters.alignment.max_step_pixels = std::numeric_limits<double>::quiet_NaN();
  try {
    parameters.validate();
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), "max_step_pixels"));
  }
  parameters = Parameters();
  parameters.alignment.levels = 9;
  EXPECT_THROW(parameters.validate(), Error);
  parameters = Parameters();
  parameters.alignment.method = static_cast<Method>(17);
  EXPECT_THROW(parameters.validate(), Error);
}

TEST(ParametersTest, TheNearLimitOfDepthIsBelowTheFarOne) {
  Parameters parameters;
  parameters.depth.min_depth = 3.0;
  parameters.depth.max_depth = 2.0;
  try {
    parameters.validate();
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), "min_depth"));
    EXPECT_TRUE(contains(error.what(), "max_depth"));
  }
}

TEST(ParametersTest, ANewKeyframeIsNeededForExactlyTheRowsThatSaySo) {
  EXPECT_FALSE(actWithKeyframe({}, {}));
  for (const ParameterInfo& info : parameterTable()) {
    Parameters changed;
    std::string value = info.default_value;
    if (info.type == Type::kEnum) {
      value = info.words[0] != info.default_value ? info.words[0] : info.words[1];
    } else if (info.type == Type::kBool) {
      value = info.default_value == "true" ? "false" : "true";
    } else {
      const bool is_minimum = std::stod(info.default_value) == info.minimum;
      value = std::to_string(is_minimum ? info.maximum : info.minimum);
    }
    setParameter(changed, info.name, value);
    EXPECT_EQ(actWithKeyframe({}, changed), info.update == Update::kKeyframe) << info.name;
  }
}

}  // namespace
}  // namespace mivo
