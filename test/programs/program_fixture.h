// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/temporary_folder.h"

namespace mivo {

/// Runs the programs of this build in a temporary folder.
class ProgramTest : public ::testing::Test {
 protected:
  static ProcessResult run(const std::string& program, const std::vector<std::string>& arguments) {
    return runProcess(std::string(MIVO_PROGRAM_FOLDER) + "/" + program, arguments);
  }

  /// Expects the exit code, nothing on stdout and one line on stderr that has `text` in it.
  static void expectRefusal(const ProcessResult& result, int exit_code, const std::string& text) {
    EXPECT_EQ(result.exit_code, exit_code) << result.errors;
    EXPECT_EQ(result.errorLines(), 1U) << result.errors;
    EXPECT_NE(result.errors.find(text), std::string::npos) << result.errors;
    EXPECT_EQ(result.output, "");
  }

  /// The number after `name: ` in the output.
  static double valueOf(const std::string& output, const std::string& name) {
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind(name + ": ", 0) == 0) return std::stod(line.substr(name.size() + 2));
    }
    ADD_FAILURE() << "no line '" << name << "' in:\n" << output;
    return -1.0;
  }

  TemporaryFolder folder_;
};

}  // namespace mivo
