// SPDX-License-Identifier: BSD-3-Clause
#include "ros/trajectory_recorder.h"

#include <gtest/gtest.h>

#include "ros/expect_error.h"
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
  EXPECT_EQ(1U, recorder.size());
}

TEST_F(TrajectoryRecorderTest, ExistingFilesAreReplacedOnlyByForce) {
  folder_.write("run.txt", "precious");
  parameters_.trajectory_file = "run.txt";
  EXPECT_ERROR(TrajectoryRecorder(parameters_), "run.txt");
  EXPECT_EQ("precious", contentOf(folder_ / "run.txt"));
  parameters_.trajectory_force = true;
  TrajectoryRecorder recorder(parameters_);
  recorder.add(makePose(1.0));
  EXPECT_EQ(1U, readTrajectory(folder_ / "run.txt").size());
  EXPECT_ERROR(recorder.save("run.txt", Overwrite::kNo), "run.txt");
}

TEST_F(TrajectoryRecorderTest, SavesWhatItKept) {
  parameters_.trajectory_length = 3;
  TrajectoryRecorder recorder(parameters_);
  EXPECT_ERROR(recorder.save("a.txt", Overwrite::kNo), "no pose");
  for (int i = 1; i <= 5; ++i) recorder.add(makePose(i));
  EXPECT_EQ(folder_ / "a.txt", recorder.save("a.txt", Overwrite::kNo));
  const Trajectory read = readTrajectory(folder_ / "a.txt");
  ASSERT_EQ(3U, read.size());
  EXPECT_EQ(3.0, read.front().stamp);
  EXPECT_EQ(folder_ / "b.txt", recorder.save(folder_ / "b.txt", Overwrite::kNo));  // absolute
  EXPECT_ERROR(recorder.save("", Overwrite::kNo), "empty");
}

}  // namespace
}  // namespace mivo
