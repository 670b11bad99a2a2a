// SPDX-License-Identifier: BSD-3-Clause
// The exit codes of a test program, tested with the disabled tests of this one.
#include <gtest/gtest.h>

#include <string>

#include "support/process.h"

namespace mivo {
namespace {

// Run by the tests below only, which check the exit codes.
TEST(TestMainExample, DISABLED_Passes) {}

TEST(TestMainExample, DISABLED_Skips) {
  GTEST_SKIP() << "something is missing";
}

TEST(TestMainExample, DISABLED_Fails) {
  FAIL() << "as it shall";
}

int exitCode(const std::string& filter) {
  return runProcess("/proc/self/exe",
                    {"--gtest_also_run_disabled_tests", "--gtest_filter=" + filter})
      .exit_code;
}

TEST(TestMain, SkippedTestsAreToldApartFromPassedOnes) {
  EXPECT_EQ(0, exitCode("TestMainExample.*Passes"));
  EXPECT_EQ(77, exitCode("TestMainExample.*Skips"));
  EXPECT_EQ(77, exitCode("TestMainExample.*Passes:TestMainExample.*Skips"));
}

TEST(TestMain, AFailureIsNotHiddenByASkippedTest) {
  EXPECT_EQ(1, exitCode("TestMainExample.*Fails"));
  EXPECT_EQ(1, exitCode("TestMainExample.*"));
}

}  // namespace
}  // namespace mivo
