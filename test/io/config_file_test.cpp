// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/config_file.h"

#include <gtest/gtest.h>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

TEST(ConfigFileTest, SetsWhatIsNamedAndNothingElse) {
  const TemporaryFolder folder;
  Parameters parameters;
  parameters.alignment.switch_level = 1;
  readParameters(folder.write("c.yaml", "# comment\nmethod: ssd\nlevels: 3\nmin_depth: 0.5\n"),
                 parameters);
  EXPECT_EQ(parameters.alignment.method, Method::kSsd);
  EXPECT_EQ(parameters.alignment.levels, 3);
  EXPECT_EQ(parameters.depth.min_depth, 0.5);
  EXPECT_EQ(parameters.alignment.switch_level, 1);
}

TEST(ConfigFileTest, EveryParameterComesBackFromItsText) {
  const TemporaryFolder folder;
  const Parameters defaults;
  std::string text;
  for (const ParameterInfo& info : parameterTable()) {
    text += info.name + ": " + getParameter(defaults, info.name) + "\n";
  }
  Parameters parameters;
  parameters.alignment.levels = 2;
  readParameters(folder.write("c.yaml", text), parameters);
  for (const ParameterInfo& info : parameterTable()) {
    EXPECT_EQ(getParameter(parameters, info.name), getParameter(defaults, info.name));
  }
}

TEST(ConfigFileTest, FileWithoutParametersChangesNothing) {
  const TemporaryFolder folder;
  Parameters parameters;
  parameters.alignment.levels = 2;
  readParameters(folder.write("c.yaml", "# only a comment\n"), parameters);
  EXPECT_EQ(parameters.alignment.levels, 2);
}

TEST(ConfigFileTest, RefusalNamesFileLineAndReasonAndChangesNothing) {
  const TemporaryFolder folder;
  const struct {
    const char* line;
    const char* reason;
  } cases[] = {{"levles: 3", "'levels'"},         {"switch_level: 99", "8"},
               {"switch_level: high", "'high'"},  {"switch_level: 1.5", "whole number"},
               {"method: best", "ssd mi hybrid"}, {"tracker: {levels: 3}", "not nested"},
               {"method: [mi, ssd]", "'method'"}, {"method:", "no value"},
               {"min_depth: .nan", "'.nan'"},     {"levels: 4", "second time"}};
  for (const auto& test : cases) {
    const std::string path =
        folder.write("c.yaml", std::string("levels: 3\n# comment\n") + test.line + "\n");
    Parameters parameters;
    const std::string text = errorText([&] { readParameters(path, parameters); });
    EXPECT_EQ(text.find(path + ":3: "), 0U) << text;
    EXPECT_NE(text.find(test.reason), std::string::npos) << text;
    EXPECT_EQ(parameters.alignment.levels, Parameters().alignment.levels);
  }
}

TEST(ConfigFileTest, RefusesWhatIsNoMapOfParameters) {
  const TemporaryFolder folder;
  Parameters parameters;
  for (const char* text : {"just text", "- levels\n- 3", "levels: [1, 2", "a: b: c"}) {
    const std::string path = folder.write("c.yaml", text);
    EXPECT_EQ(errorText([&] { readParameters(path, parameters); }).find(path + ":"), 0U) << text;
  }
  EXPECT_NE(errorText([&] { readParameters(folder / "no.yaml", parameters); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(errorText([&] { readParameters(folder.path(), parameters); }).find("folder"),
            std::string::npos);
}

}  // namespace
}  // namespace mivo
