// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/trajectory_io.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <limits>

#include "mivo/core/se3.h"
#include "support/error_text.h"
#include "support/full_disk.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

StampedPose samplePose() {
  Vector6 twist;
  twist << 1.23456789012345, -987.654321, 1e-7, 1.0, -2.0, 0.5;
  return {1305031229.528748, expSe3(twist)};
}

TEST(TrajectoryIoTest, PosesComeBack) {
  const TemporaryFolder folder;
  TrajectoryWriter writer(folder / "trajectory.txt", Overwrite::kNo);
  const StampedPose pose = samplePose();
  writer.write(pose);
  writer.write({pose.stamp + 1.0, Eigen::Isometry3d::Identity()});
  const Trajectory trajectory = readTrajectory(folder / "trajectory.txt");
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_NEAR(trajectory[0].stamp, pose.stamp, 5e-7);
  // 12 significant digits of up to 1000 m.
  EXPECT_TRUE(trajectory[0].pose.matrix().isApprox(pose.pose.matrix(), 1e-11));
  EXPECT_EQ(trajectory[1].pose.matrix(), Eigen::Matrix4d::Identity());
}

TEST(TrajectoryIoTest, LineIsTheFormatOfTheBenchmark) {
  StampedPose pose{1.5, Eigen::Isometry3d::Identity()};
  pose.pose.translation() << 1.0, -2.5, 0.125;
  // Half a turn about y, from a quaternion whose scalar part is negative.
  pose.pose.linear() = Eigen::Quaterniond(-0.5, 0.5, -0.5, 0.5).toRotationMatrix();
  EXPECT_EQ(trajectoryLine(pose), "1.500000 1 -2.5 0.125 -0.5 0.5 -0.5 0.5\n");
}

TEST(TrajectoryIoTest, EachPoseIsOnDiskAtOnce) {
  const TemporaryFolder folder;
  TrajectoryWriter writer(folder / "trajectory.txt", Overwrite::kNo);
  writer.write(samplePose());
  EXPECT_EQ(readTrajectory(folder / "trajectory.txt").size(), 1U);  // the writer is still open
}

TEST(TrajectoryIoTest, AWholeTrajectoryIsWrittenAtOnceOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string path = folder / "trajectory.txt";
  const Trajectory poses(3, samplePose());
  writeTrajectory(path, poses, Overwrite::kNo);
  const std::string written = contentOf(path);
  EXPECT_EQ(written, "# stamp tx ty tz qx qy qz qw\n" + trajectoryLine(poses[0]) +
                         trajectoryLine(poses[0]) + trajectoryLine(poses[0]));
  EXPECT_EQ(errorText([&] { writeTrajectory(path, poses, Overwrite::kNo); }),
            path + " exists: choose another name, or --force to replace it");
  EXPECT_EQ(errorText([&] { writeTrajectory(path, poses, Overwrite::kNo, "set force"); }),
            path + " exists: set force");
  {
    const FullDisk disk(written.size());
    EXPECT_NE(errorText([&] {
                writeTrajectory(path, Trajectory(9, samplePose()), Overwrite::kYes);
              }).find("cannot write"),
              std::string::npos);
  }
  EXPECT_EQ(contentOf(path), written);
  writeTrajectory(path, {samplePose()}, Overwrite::kYes);
  EXPECT_EQ(readTrajectory(path).size(), 1U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(TrajectoryIoTest, ReadsCommentsBlanksTabsAndWindowsLineEnds) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("t.txt", "# comment\n\n  # indented\r\n1 2\t3 4 0 0 0 1\r\n2,3,4,5,0,0,0,1");
  const Trajectory trajectory = readTrajectory(path);
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[0].pose.translation(), Eigen::Vector3d(2, 3, 4));
  EXPECT_EQ(trajectory[1].stamp, 2.0);
}

TEST(TrajectoryIoTest, RoundedQuaternionIsNormalized) {
  const TemporaryFolder folder;
  const Trajectory trajectory =
      readTrajectory(folder.write("t.txt", "0 0 0 0 0.7071 0 0 0.7070\n"));
  const Eigen::Matrix3d R = trajectory.front().pose.linear();
  EXPECT_TRUE((R * R.transpose()).isIdentity(1e-14));
  EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
}

TEST(TrajectoryIoTest, RefusesWhatIsNoPoseWithFileAndLine) {
  const TemporaryFolder folder;
  const std::string good = "0 0 0 0 0 0 0 1\n";
  for (const char* line : {"1 2 3", "1 0 0 0 0 0 0 1 9", "nan 0 0 0 0 0 0 1", "1 inf 0 0 0 0 0 1",
                           "1 0 0 0 0 0 nan 1", "1 0 0 0 0 0 0 0", "1 0 0 0 0 0 0 2",
                           "1 0 0 x 0 0 0 1", "1 0 0 1.5x 0 0 0 1", "1 0 0 1e999 0 0 0 1"}) {
    const std::string path = folder.write("t.txt", good + "# comment\n" + line + "\n" + good);
    EXPECT_EQ(errorText([&] { readTrajectory(path); }).find(path + ":3: "), 0U) << line;
  }
}

TEST(TrajectoryIoTest, RefusesFilesWithoutPoses) {
  const TemporaryFolder folder;
  const std::string empty = folder.write("empty.txt", "# nothing\n");
  EXPECT_EQ(errorText([&] { readTrajectory(empty); }), empty + " holds no pose");
  EXPECT_NE(errorText([&] { readTrajectory(folder / "no.txt"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(errorText([&] { readTrajectory(folder.path()); }).find("it is a folder"),
            std::string::npos);
}

TEST(TrajectoryIoTest, WriterRefusesPosesThatAreNotFinite) {
  const TemporaryFolder folder;
  TrajectoryWriter writer(folder / "t.txt", Overwrite::kNo);
  StampedPose pose = samplePose();
  pose.pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(writer.write(pose), Error);
  pose = samplePose();
  pose.stamp = std::numeric_limits<double>::infinity();
  EXPECT_THROW(writer.write(pose), Error);
}

}  // namespace
}  // namespace mivo
