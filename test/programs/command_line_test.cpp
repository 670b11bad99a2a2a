// SPDX-License-Identifier: BSD-3-Clause
#include "programs/command_line.h"

#include <gtest/gtest.h>

#include <iostream>

#include "mivo/core/error.h"

namespace mivo {
namespace {

namespace po = boost::program_options;

class CommandLineTest : public ::testing::Test {
 protected:
  CommandLineTest() : line_("tool", "Does something.") {
    line_.argument("IN", &in_, "input");
    line_.argument("OUT", &out_, "output");
    line_.options()("number", po::value(&number_)->default_value(5), "a number")(
        "pair", twoNumbers(&pair_), "two numbers");
  }

  bool parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "tool");
    return line_.parse(static_cast<int>(arguments.size()), arguments.data());
  }

  std::string in_;
  std::string out_;
  int number_ = 0;
  std::vector<double> pair_;
  CommandLine line_;
};

TEST_F(CommandLineTest, SetsArgumentsAndOptions) {
  ASSERT_TRUE(parse({"a", "--number", "7", "b"}));
  EXPECT_EQ(in_, "a");
  EXPECT_EQ(out_, "b");
  EXPECT_EQ(number_, 7);
  EXPECT_TRUE(line_.has("number"));
  EXPECT_FALSE(line_.has("pair"));
}

TEST_F(CommandLineTest, DefaultIsNotGiven) {
  ASSERT_TRUE(parse({"a", "b"}));
  EXPECT_EQ(number_, 5);
  EXPECT_FALSE(line_.has("number"));
}

TEST_F(CommandLineTest, PairTakesTwoNumbersAndLeavesTheArguments) {
  ASSERT_TRUE(parse({"--pair", "0.5", "1e-3", "a", "b"}));
  EXPECT_EQ(pair_, (std::vector<double>{0.5, 1e-3}));
  EXPECT_EQ(in_, "a");
  EXPECT_EQ(out_, "b");
}

/// A tool that takes several bags and a folder.
class CommandLineListTest : public ::testing::Test {
 protected:
  CommandLineListTest() {
    line_.arguments("BAG", &bags_, "inputs");
    line_.argument("FOLDER", &folder_, "output");
  }

  void parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "tool");
    line_.parse(static_cast<int>(arguments.size()), arguments.data());
  }

  std::vector<std::string> bags_;
  std::string folder_;
  CommandLine line_{"tool", "Does something."};
};

TEST_F(CommandLineListTest, TakesWhatTheOtherArgumentsLeave) {
  parse({"a", "b", "c", "out"});
  EXPECT_EQ(bags_, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(folder_, "out");
  EXPECT_NE(line_.help().find("tool BAG... FOLDER"), std::string::npos);
}

TEST_F(CommandLineListTest, NeedsOneOfThem) {
  EXPECT_THROW(parse({"a"}), UsageError);
}

TEST_F(CommandLineTest, WrongUsageIsRefused) {
  EXPECT_THROW(parse({"a"}), UsageError);
  EXPECT_THROW(parse({"a", "b", "c"}), UsageError);
  EXPECT_THROW(parse({"a", "b", "--number"}), UsageError);
  EXPECT_THROW(parse({"a", "b", "--number", "x"}), UsageError);
  EXPECT_THROW(parse({"a", "b", "--numb", "7"}), UsageError);  // no abbreviations
  EXPECT_THROW(parse({"a", "b", "--unknown"}), UsageError);
  EXPECT_THROW(parse({"a", "b", "--pair", "1"}), UsageError);
  EXPECT_THROW(parse({"a", "b", "--pair", "1", "x"}), UsageError);
}

TEST_F(CommandLineTest, AnUnknownOptionIsAnsweredWithTheNearestOne) {
  const auto refusal = [&](const char* option) {
    try {
      parse({"a", "b", option});
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  EXPECT_EQ(refusal("--nunber"), "unknown option '--nunber'; did you mean '--number'?");
  EXPECT_EQ(refusal("--par=1"), "unknown option '--par'; did you mean '--pair'?");
  EXPECT_EQ(refusal("--something"), "unknown option '--something'");
  EXPECT_EQ(refusal("-x"), "unknown option '-x'");
}

TEST_F(CommandLineTest, ShortHelpIsHelp) {
  for (const char* option : {"-h", "--help"}) {
    testing::internal::CaptureStdout();
    EXPECT_FALSE(parse({option})) << option;
    EXPECT_EQ(testing::internal::GetCapturedStdout(), line_.help());
  }
}

TEST_F(CommandLineTest, HelpNamesEverything) {
  const std::string help = line_.help();
  for (const char* text :
       {"Does something.", "tool IN OUT [options]", "--number", "--pair", "--help", "--version"}) {
    EXPECT_NE(help.find(text), std::string::npos) << text;
  }
}

/// As the file behind a redirection on a full disk.
class FullDisk : public std::streambuf {};

TEST(RunProgramTest, OutputThatCannotBeWrittenIsAFailure) {
  FullDisk disk;
  std::streambuf* const usual = std::cout.rdbuf(&disk);
  testing::internal::CaptureStderr();
  const int code = runProgram("tool", [] { std::cout << "frames: 40\n"; });
  std::cout.rdbuf(usual);
  std::cout.clear();
  EXPECT_EQ(code, 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "tool: cannot write to the standard output: is the disk full?\n");
}

TEST(RunProgramTest, ExceptionsBecomeExitCodesAndOneLine) {
  const auto run = [](const std::function<void()>& body, std::string& errors) {
    testing::internal::CaptureStderr();
    const int code = runProgram("tool", body);
    errors = testing::internal::GetCapturedStderr();
    return code;
  };
  std::string errors;
  EXPECT_EQ(run([] {}, errors), 0);
  EXPECT_EQ(errors, "");
  EXPECT_EQ(run([] { throw Error("bad\n\x1b\x7finput"); }, errors), 1);
  EXPECT_EQ(errors, "tool: bad   input\n");
  EXPECT_EQ(run([] { throw UsageError("what"); }, errors), 2);
  EXPECT_EQ(errors, "tool: what (see tool --help)\n");
  EXPECT_EQ(run([] { throw std::bad_alloc(); }, errors), 1);
  EXPECT_EQ(errors, "tool: std::bad_alloc\n");
}

}  // namespace
}  // namespace mivo
