// SPDX-License-Identifier: BSD-3-Clause
#include "io/trajectory_format.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/pose_folder.h"
#include "mivo/io/trajectory_io.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

// One pose in all formats: at 1600000001.5 s, turned by 60 degrees about (0, 0.6, 0.8).
constexpr double kStamp = 1600000001.5;
const Eigen::Vector3d kPosition(1.0, -2.0, 3.5);
const Eigen::AngleAxisd kRotation(M_PI / 3.0, Eigen::Vector3d(0.0, 0.6, 0.8));
const std::string kXyzw = "0 0.3 0.4 0.866025403784";
const std::string kWxyz = "0.866025403784 0 0.3 0.4";

std::string withCommas(std::string text) {
  for (char& character : text) {
    if (character == ' ') character = ',';
  }
  return text;
}

class TrajectoryFormatTest : public ::testing::Test {
 protected:
  TrajectoryFile read(const std::string& content) {
    return readTrajectoryFile(folder_.write("trajectory", content));
  }

  void expectPose(const std::string& content, const std::string& notice, double stamp = kStamp) {
    SCOPED_TRACE(content);
    TrajectoryFile file;
    ASSERT_EQ(errorText([&] { file = read(content); }), "nothing thrown");
    ASSERT_EQ(file.poses.size(), 1U);
    EXPECT_NEAR(file.poses[0].stamp, stamp, 1e-6);
    EXPECT_LT((file.poses[0].pose.translation() - kPosition).norm(), 1e-12);
    EXPECT_LT((file.poses[0].pose.linear() - kRotation.toRotationMatrix()).norm(), 1e-9);
    ASSERT_EQ(file.notices.size(), notice.empty() ? 0U : 1U);
    if (!notice.empty()) {
      EXPECT_NE(file.notices[0].find(notice), std::string::npos) << file.notices[0];
    }
  }

  void expectRefusal(const std::string& content, const std::string& text) {
    EXPECT_NE(errorText([&] { read(content); }).find(text), std::string::npos)
        << errorText([&] { read(content); });
  }

  TemporaryFolder folder_;
};

TEST_F(TrajectoryFormatTest, Tum) {
  const std::string line = "1600000001.5 1 -2 3.5 " + kXyzw;
  for (const std::string& content :
       {line, line + "\r\n", "\r" + line + "\r", "\xEF\xBB\xBF" + line, withCommas(line),
        withCommas(line) + ",", line + " ", "# ground truth\n" + line}) {
    expectPose(content, "");
    EXPECT_TRUE(read(content).is_order_assumed);
  }
  expectPose("# timestamp tx ty tz qx qy qz qw\n" + line, "");
  EXPECT_FALSE(read("# timestamp tx ty tz qx qy qz qw\n" + line).is_order_assumed);
}

TEST_F(TrajectoryFormatTest, StampsOfOtherUnitsAreSeconds) {
  for (const auto& [stamp, unit] : {std::make_pair("1600000001500", "milliseconds"),
                                    {"1600000001500000", "microseconds"},
                                    {"1600000001500000000", "nanoseconds"}}) {
    expectPose(stamp + (" 1 -2 3.5 " + kXyzw), std::string("its stamps are ") + unit);
  }
}

TEST_F(TrajectoryFormatTest, Euroc) {
  const std::string numbers = "1600000001500000000 1 -2 3.5 " + kWxyz;
  const std::string more = " 0 0 0 0 0 0 0 0 0";
  expectPose(withCommas(numbers), "EuRoC");
  expectPose(withCommas(numbers + more), "EuRoC");
  expectPose(
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], "
      "q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], "
      "b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], "
      "b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]\n" +
          withCommas(numbers + more),
      "qw before qx, as its heading says");
}

TEST_F(TrajectoryFormatTest, ANameThatEndsWithAZeroIsNoAxis) {
  expectRefusal(std::string("# t tx ty translation\0 qx qy qz qw\n1 2 3 4 0 0 0 2\n", 51),
                "the quaternion has length 2");
}

TEST_F(TrajectoryFormatTest, HeadingsNameTheColumns) {
  const std::string numbers = "1600000001.5 1 -2 3.5 " + kWxyz;
  for (const char* heading : {"timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z", "#t,x,y,z,qw,qx,qy,qz",
                              "time [s],pos_x,pos_y,pos_z,quat_w,quat_x,quat_y,quat_z"}) {
    expectPose(heading + ("\n" + withCommas(numbers)), "qw before qx, as its heading says");
  }
  expectPose("qx qy qz qw stamp vel_x x y z\n" + kXyzw + " 1600000001.5 9 1 -2 3.5", "");
  expectPose(
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,"
      "field.pose.position.x,field.pose.position.y,field.pose.position.z,"
      "field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,"
      "field.pose.orientation.w\n1600000001500000000,7,1600000001400000000,map,1,-2,3.5," +
          withCommas(kXyzw),
      "");
}

TEST_F(TrajectoryFormatTest, KittiHasNoStamps) {
  const Eigen::Matrix3d R = kRotation.toRotationMatrix();
  std::string line;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) line += std::to_string(R(row, column)) + " ";
    line += std::to_string(kPosition[row]) + " ";
  }
  const TrajectoryFile file = read(line + "\n" + line + "\n");
  ASSERT_EQ(file.poses.size(), 2U);
  EXPECT_EQ(file.poses[0].stamp, 0.0);
  EXPECT_EQ(file.poses[1].stamp, 1.0);
  EXPECT_LT((file.poses[1].pose.linear() - R).norm(), 1e-5);
  EXPECT_LT((file.poses[1].pose.linear().transpose() * file.poses[1].pose.linear() -
             Eigen::Matrix3d::Identity())
                .norm(),
            1e-12);
  EXPECT_LT((file.poses[1].pose.translation() - kPosition).norm(), 1e-6);
  ASSERT_EQ(file.notices.size(), 1U);
  EXPECT_NE(file.notices[0].find("KITTI"), std::string::npos);
  expectRefusal("1 2 3 4 5 6 7 8 9 10 11 12\n", ":1: the 12 numbers are no pose");
  expectRefusal(line + "\n1 2 3\n", ":2: expected 12 numbers, found 3");
}

TEST_F(TrajectoryFormatTest, Ros2Csv) {
  const std::string pose = "1,-2,3.5," + withCommas(kXyzw);
  expectPose("1600000001,500000000,map," + pose, "ros2 topic echo");
  expectPose("1600000001,500000000,odom,base_link," + pose + ",0.1,0,0,0", "ros2 topic echo");
  expectRefusal("1600000001,500000000,map,frame,frame,frame,frame,1,2,3\n", "7 numbers of a pose");
}

TEST_F(TrajectoryFormatTest, OthersAreRefusedWithFileAndLine) {
  expectRefusal("1 2 3 4 5 6 7 8 9\n",
                ":1: expected 8 numbers 'stamp tx ty tz qx qy qz qw', found 9");
  expectRefusal("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n", ":2: expected 8 numbers");
  expectRefusal("some words\n0 0 0 0 0 0 0 1\n", ":1: expected 8 numbers");
  expectRefusal("t,x,y,z,qw,qx,qy,qz\n0,1,2,3,1,0,0\n", ":2: expected 8 numbers, found 7");
  expectRefusal("t,x,y,z,qw,qx,qy,qz\n", " holds no pose");
  expectRefusal("0 0 0 0 0 0 0 0.5\n", ":1: the quaternion has length 0.5");
}

// The same pose as a matrix, as data sets have it.
class PoseFolderTest : public ::testing::Test {
 protected:
  static std::string matrixOf(const Eigen::Isometry3d& pose) {
    std::ostringstream text;
    text << pose.matrix().format(Eigen::IOFormat(9)) << "\n";
    return text.str();
  }

  static Eigen::Isometry3d pose() {
    Eigen::Isometry3d pose(kRotation);
    pose.translation() = kPosition;
    return pose;
  }

  TemporaryFolder folder_;
};

TEST_F(PoseFolderTest, SevenScenesAndScanNet) {
  for (const bool is_scan_net : {false, true}) {
    const TemporaryFolder folder;
    const auto name = [&](int i) {
      return is_scan_net ? "pose/" + std::to_string(i) + ".txt"
                         : "frame-00000" + std::to_string(i) + ".pose.txt";
    };
    folder.write(name(0), matrixOf(Eigen::Isometry3d::Identity()));
    folder.write(name(3), matrixOf(pose()));
    folder.write(name(6),
                 "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n0 0 0 1\n");
    const TrajectoryFile file = readPoseFolder(folder.path());
    ASSERT_EQ(file.poses.size(), 2U);
    EXPECT_EQ(file.poses[0].stamp, 0.0);
    EXPECT_DOUBLE_EQ(file.poses[1].stamp, 0.1);
    EXPECT_LT((file.poses[1].pose.matrix() - pose().matrix()).norm(), 1e-7);
    ASSERT_EQ(file.notices.size(), 1U);
    EXPECT_NE(file.notices[0].find("30 Hz are assumed"), std::string::npos);
  }
}

TEST_F(PoseFolderTest, TumsTruthIsTakenFromItsFile) {
  folder_.write("groundtruth.txt", "1600000001.5 1 -2 3.5 " + kXyzw + "\n");
  const TrajectoryFile file = readPoseFolder(folder_.path());
  ASSERT_EQ(file.poses.size(), 1U);
  EXPECT_EQ(file.poses[0].stamp, kStamp);
}

TEST_F(PoseFolderTest, OthersAreRefused) {
  EXPECT_NE(errorText([&] { readPoseFolder(folder_.path()); }).find(" holds no true path"),
            std::string::npos);
  for (const auto& [text, what] :
       {std::pair{"1 2 3", ": expected 16 numbers of a pose's matrix, found 3"},
        {"1 0 0 0 0 1 0 0 0 0 2 0 0 0 0 1", ": the matrix has no rotation in its first columns"},
        {"1 0 0 x 0 1 0 0 0 0 1 0 0 0 0 1", ": 'x' is no number"}}) {
    const std::string path = folder_.write("frame-000000.pose.txt", text);
    EXPECT_EQ(errorText([&] { readPoseFolder(folder_.path()); }), path + what);
  }
}

}  // namespace
}  // namespace mivo
