// SPDX-License-Identifier: BSD-3-Clause
#include "programs/output_paths.h"

#include <gtest/gtest.h>

#include <exception>
#include <filesystem>
#include <string>

#include "programs/command_line.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

class OutputPathsTest : public ::testing::Test {
 protected:
  std::string refusal(const std::string& a, const std::string& b, const std::string& input = "",
                      Overwrite overwrite = Overwrite::kNo) {
    try {
      requireOutputs({{"--a", a}, {"--b", b}}, {{"IN", input}}, overwrite);
    } catch (const std::exception& error) {
      return error.what();
    }
    return kNone;
  }

  const std::string kNone = "nothing thrown";
  TemporaryFolder folder_;
};

TEST_F(OutputPathsTest, DifferentFilesAreFineAndNotCreated) {
  EXPECT_EQ(refusal(folder_ / "a", folder_ / "b"), kNone);
  EXPECT_EQ(refusal("", ""), kNone);
  EXPECT_EQ(refusal("/dev/null", "/dev/null", "", Overwrite::kYes), kNone);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a"));
}

TEST_F(OutputPathsTest, OneFileByTwoSpellingsIsRefused) {
  const std::string text = "--a and --b name the same file";
  EXPECT_EQ(refusal(folder_ / "a", folder_ / "a"), text);
  EXPECT_EQ(refusal(folder_ / "a", folder_ / "./a"), text);
  EXPECT_EQ(refusal(folder_ / "a", folder_ / "x/../a"), text);
  const std::string file = folder_.write("file", "mine");
  std::filesystem::create_symlink(file, folder_ / "symbolic");
  std::filesystem::create_hard_link(file, folder_ / "hard");
  EXPECT_EQ(refusal(file, folder_ / "symbolic", "", Overwrite::kYes), text);
  EXPECT_EQ(refusal(file, folder_ / "hard", "", Overwrite::kYes), text);
  EXPECT_EQ(contentOf(file), "mine");
  EXPECT_THROW(requireOutputs({{"--a", file}, {"--b", file}}, {}, Overwrite::kYes), UsageError);
}

TEST_F(OutputPathsTest, InputsAreNotWritten) {
  const std::string input = folder_.write("input", "read");
  EXPECT_EQ(refusal("", folder_ / "./input", input, Overwrite::kYes),
            "--b names IN, which is read");
  EXPECT_EQ(contentOf(input), "read");
}

TEST_F(OutputPathsTest, WhatCannotBeCreatedIsRefusedByName) {
  EXPECT_EQ(refusal(folder_ / "a", folder_ / "no/b"),
            "cannot create " + (folder_ / "no/b") + ": No such file or directory");
  const std::string file = folder_.write("file", "mine");
  EXPECT_NE(refusal(folder_ / "a", file).find(file + " exists"), std::string::npos);
  EXPECT_NE(refusal(folder_ / "a", folder_.path()).find("it is a folder"), std::string::npos);
  EXPECT_EQ(refusal(folder_ / "a", file + "/b").find("cannot create " + file + "/b: "), 0U);
}

}  // namespace
}  // namespace mivo
