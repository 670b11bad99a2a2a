// SPDX-License-Identifier: BSD-3-Clause
#include "ros/trajectory_recorder.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ros/expect_error.h"
#include "support/full_disk.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

StampedPose makePose(double stamp) {
  StampedPose pose;
  pose.stamp = stamp;
  pose.pose.translation().x() = 10.0 * stamp;
  return pose;
}

class TrajectoryRecorderTest : public ::testing::Test {
 protected:
  TrajectoryRecorderTest() { parameters_.trajectory_folder = folder_.path(); }

  TemporaryFolder folder_;
  NodeParameters parameters_;
};

TEST_F(TrajectoryRecorderTest, FileGrowsPoseByPose) {
  parameters_.trajectory_file = "run.txt";
  TrajectoryRecorder recorder(parameters_);
  recorder.add(makePose(1.0));
  recorder.add(makePose(2.0));
  const Trajectory read = readTrajectory(folder_ / "run.txt");  // while the recorder lives
  ASSERT_EQ(2U, read.size());
  EXPECT_EQ(20.0, read[1].pose.translation().x());
}

TEST_F(TrajectoryRecorderTest, ANewStartBeginsAnotherFile) {
  parameters_.trajectory_file = "run.txt";
  TrajectoryRecorder recorder(parameters_);
  recorder.startAnew();  // nothing was written yet: still the first file
  recorder.add(makePose(5.0));
  recorder.startAnew();
  recorder.add(makePose(1.0));
  EXPECT_EQ(5.0, readTrajectory(folder_ / "run.txt").at(0).stamp);
  EXPECT_EQ(1.0, readTrajectory(folder_ / "run_2.txt").at(0).stamp);
  EXPECT_EQ(1U, recorder.poses().size());
}

TEST_F(TrajectoryRecorderTest, ExistingFilesAreReplacedOnlyByForce) {
  folder_.write("run.txt", "precious");
  parameters_.trajectory_file = "run.txt";
  EXPECT_ERROR(TrajectoryRecorder(parameters_),
               "run.txt exists: set another trajectory_file, or trajectory_force to replace it");
  EXPECT_EQ("precious", contentOf(folder_ / "run.txt"));
  parameters_.trajectory_force = true;
  TrajectoryRecorder recorder(parameters_);
  recorder.add(makePose(1.0));
  EXPECT_EQ(1U, readTrajectory(folder_ / "run.txt").size());
}

TEST_F(TrajectoryRecorderTest, KeepsTheLastPoses) {
  parameters_.trajectory_length = 3;
  TrajectoryRecorder recorder(parameters_);
  for (int i = 1; i <= 5; ++i) recorder.add(makePose(i));
  const Trajectory poses = recorder.poses();
  ASSERT_EQ(3U, poses.size());
  EXPECT_EQ(3.0, poses.front().stamp);
  EXPECT_EQ(5.0, poses.back().stamp);
}

TEST_F(TrajectoryRecorderTest, SavesInItsFolderAlone) {
  TrajectoryRecorder recorder(parameters_);
  EXPECT_ERROR(recorder.pathToSave("a.txt", Overwrite::kNo), "no pose");
  recorder.add(makePose(1.0));
  EXPECT_EQ(folder_ / "a.txt", recorder.pathToSave("a.txt", Overwrite::kNo));
  EXPECT_EQ(folder_ / "b/c.txt", recorder.pathToSave(folder_ / "b/c.txt", Overwrite::kNo));
  EXPECT_ERROR(recorder.pathToSave("", Overwrite::kNo), "empty");

  const std::string remedy = "is outside of " + folder_.path() + ", the trajectory_folder";
  EXPECT_ERROR(recorder.pathToSave("../a.txt", Overwrite::kYes), remedy);
  EXPECT_ERROR(recorder.pathToSave("b/../../a.txt", Overwrite::kYes), remedy);
  EXPECT_ERROR(recorder.pathToSave(folder_.path() + "2/a.txt", Overwrite::kYes), remedy);
  EXPECT_ERROR(recorder.pathToSave("/etc/passwd", Overwrite::kYes), remedy);
  std::filesystem::create_directory_symlink("/tmp", folder_ / "link");
  EXPECT_ERROR(recorder.pathToSave("link/a.txt", Overwrite::kYes), remedy);
}

TEST_F(TrajectoryRecorderTest, SavesOverAnotherFileOnlyWhenForced) {
  folder_.write("old.txt", "precious");
  parameters_.trajectory_file = "run.txt";
  TrajectoryRecorder recorder(parameters_);
  recorder.add(makePose(1.0));
  EXPECT_ERROR(recorder.pathToSave("old.txt", Overwrite::kNo),
               "old.txt exists: choose another name, or set force to replace it");
  EXPECT_EQ(folder_ / "old.txt", recorder.pathToSave("old.txt", Overwrite::kYes));
  EXPECT_EQ("precious", contentOf(folder_ / "old.txt"));
}

TEST_F(TrajectoryRecorderTest, NeverSavesOverTheFileThatIsBeingWritten) {
  parameters_.trajectory_file = "run.txt";
  TrajectoryRecorder recorder(parameters_);
  recorder.add(makePose(1.0));
  std::filesystem::create_hard_link(folder_ / "run.txt", folder_ / "same.txt");
  for (const char* name : {"run.txt", "./run.txt", "same.txt"}) {
    EXPECT_ERROR(recorder.pathToSave(name, Overwrite::kYes), "which is being written");
  }
}

TEST_F(TrajectoryRecorderTest, AFullDiskCostsOnlyThePosesThatDidNotFit) {
  parameters_.trajectory_file = "run.txt";
  TrajectoryRecorder recorder(parameters_);
  recorder.add(makePose(1.0));
  {
    const FullDisk disk(std::filesystem::file_size(folder_ / "run.txt") + 10);
    EXPECT_ERROR(recorder.add(makePose(2.0)), "cannot write");
  }
  recorder.add(makePose(3.0));
  const Trajectory read = readTrajectory(folder_ / "run.txt");
  ASSERT_EQ(2U, read.size());
  EXPECT_EQ(3.0, read[1].stamp);
  EXPECT_EQ(3U, recorder.poses().size());
}

}  // namespace
}  // namespace mivo
