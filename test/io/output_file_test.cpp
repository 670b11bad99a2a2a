// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/output_file.h"

#include <gtest/gtest.h>

#include "support/error_text.h"
#include "support/full_disk.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

TEST(OutputFileTest, ExistingFileIsKeptUnlessItMayBeReplaced) {
  const TemporaryFolder folder;
  const std::string path = folder.write("file", "old");
  EXPECT_NE(errorText([&] { OutputFile(path, Overwrite::kNo); }).find(path + " exists"),
            std::string::npos);
  EXPECT_EQ(contentOf(path), "old");
  OutputFile(path, Overwrite::kYes).write("new");
  EXPECT_EQ(contentOf(path), "new");
}

TEST(OutputFileTest, EachPieceIsOnDiskAtOnce) {
  const TemporaryFolder folder;
  OutputFile file(folder / "file", Overwrite::kNo);
  file.write("one");
  EXPECT_EQ(contentOf(file.path()), "one");
  file.write("two");
  EXPECT_EQ(contentOf(file.path()), "onetwo");
}

TEST(OutputFileTest, ReportsWhereNothingCanBeCreated) {
  const TemporaryFolder folder;
  EXPECT_NE(errorText([&] {
              OutputFile(folder / "no/such/file", Overwrite::kNo);
            }).find("No such file or directory"),
            std::string::npos);
  EXPECT_NE(errorText([&] { OutputFile(folder.path(), Overwrite::kYes); }).find("folder"),
            std::string::npos);
}

TEST(OutputFileTest, FullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  OutputFile file("/dev/full", Overwrite::kYes);
  EXPECT_NE(errorText([&] { file.write("text"); }).find("No space left"), std::string::npos);
}

TEST(OutputFileTest, AFullDiskLeavesWholePiecesAndLaterOnesGoOn) {
  const TemporaryFolder folder;
  OutputFile file(folder / "file", Overwrite::kNo);
  file.write("first\n");
  {
    const FullDisk disk(9);
    EXPECT_EQ(errorText([&] { file.write("second\n"); }),
              "cannot write " + file.path() + ": File too large");
    EXPECT_EQ(contentOf(file.path()), "first\n");
    EXPECT_NE(errorText([&] { file.write("second\n"); }).find("cannot write"), std::string::npos);
    file.write("2\n");  // what fits
  }
  file.write("third\n");
  EXPECT_EQ(contentOf(file.path()), "first\n2\nthird\n");
}

}  // namespace
}  // namespace mivo
