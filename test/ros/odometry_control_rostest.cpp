// SPDX-License-Identifier: BSD-3-Clause
// Services, parameters, loading and unloading.
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <mivo/SaveTrajectory.h>
#include <mivo/SetPose.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <cmath>
#include <fstream>
#include <vector>

#include "mivo/core/parameters.h"
#include "mivo/core/se3.h"
#include "mivo/io/trajectory_io.h"
#include "programs/plane_sequence.h"
#include "ros/expect_error.h"
#include "ros/node_fixture.h"
#include "ros/node_parameters.h"
#include "ros/parameter_server.h"
#include "ros/pose_conversion.h"
#include "ros/stamp.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

constexpr double kTolerance = 0.006;  // as in odometry_rostest

TEST_F(NodeTest, ResetStartsAtTheOrigin) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 5; ++i) track(i);
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call(privateName("reset"), reset));
  EXPECT_TRUE(reset.response.success);
  track(5);
  ASSERT_TRUE(waitFor([&] { return isDone(5); }));
  EXPECT_LT(poseError(5, Eigen::Isometry3d::Identity()), 1e-9);
  track(6);
  ASSERT_TRUE(waitFor([&] { return isDone(6); }));
  EXPECT_LT(poseError(6, truth(5).inverse() * truth(6)), kTolerance);
  EXPECT_EQ(2U, statusOf(6).frames);
}

TEST_F(NodeTest, SetPoseMovesTheOdometryFrame) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 5; ++i) track(i);
  Eigen::Isometry3d wanted = Eigen::Isometry3d::Identity();
  wanted.translation() << 3.0, -2.0, 1.0;
  wanted.linear() = expSo3({0.0, 0.0, 1.0});
  SetPose call;
  call.request.pose = toPose(wanted);
  ASSERT_TRUE(ros::service::call(privateName("set_pose"), call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  track(5);
  ASSERT_TRUE(waitFor([&] { return isDone(5); }));
  EXPECT_LT(poseError(5, wanted * truth(4).inverse() * truth(5)), kTolerance);
  EXPECT_EQ(statusOf(4).segment, statusOf(5).segment);
  EXPECT_EQ(statusOf(4).keyframes, statusOf(5).keyframes);

  call.request.pose = geometry_msgs::Pose();  // a quaternion of zeros
  ASSERT_TRUE(ros::service::call(privateName("set_pose"), call));
  EXPECT_FALSE(call.response.success);
  EXPECT_NE(std::string::npos, call.response.message.find("quaternion"));
}

TEST_F(NodeTest, SetPoseIsRefusedBeforeThereIsAPose) {
  publishCameraOnBase();
  load();  // reset at its end
  SetPose call;
  call.request.pose.orientation.w = 1.0;
  ASSERT_TRUE(ros::service::call(privateName("set_pose"), call));
  EXPECT_FALSE(call.response.success);
}

TEST_F(NodeTest, PauseStopsTracking) {
  publishCameraOnBase();
  load();
  track(0);
  std_srvs::SetBool pause;
  pause.request.data = 1;
  ASSERT_TRUE(ros::service::call(privateName("pause"), pause));
  publish(1);
  diagnosis("tracking", [](const std::string& text) { return text == "paused"; });
  EXPECT_FALSE(holds([&] { return hasStatus(1); }));
  pause.request.data = 0;
  ASSERT_TRUE(ros::service::call(privateName("pause"), pause));
  track(2);
  EXPECT_EQ(2U, statusOf(2).frames);
}

TEST_F(NodeTest, TrajectoryIsSavedAndWrittenAsItGrows) {
  const TemporaryFolder folder;
  publishCameraOnBase();
  setParameter("trajectory_folder", folder.path());
  setParameter("trajectory_file", "live.txt");
  load();
  for (int i = 0; i < 5; ++i) track(i);
  SaveTrajectory call;
  call.request.path = "saved.txt";
  ASSERT_TRUE(ros::service::call(privateName("save_trajectory"), call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  EXPECT_EQ(5U, call.response.poses);
  EXPECT_EQ(folder / "saved.txt", call.response.message);
  const Trajectory saved = readTrajectory(folder / "saved.txt");
  ASSERT_EQ(5U, saved.size());
  // Poses of the camera; its first one is the origin.
  EXPECT_LT(localCoordinates(saved[0].pose).norm(), 1e-9);
  EXPECT_LT(localCoordinates(planePose(4).inverse() * saved[4].pose).norm(), kTolerance);
  // The reset at the end of load() began the second file.
  EXPECT_EQ(contentOf(folder / "saved.txt"), contentOf(folder / "live_2.txt"));

  ASSERT_TRUE(ros::service::call(privateName("save_trajectory"), call));
  EXPECT_FALSE(call.response.success);
  call.request.force = 1;
  ASSERT_TRUE(ros::service::call(privateName("save_trajectory"), call));
  EXPECT_TRUE(call.response.success);
}

class LostFramesTest : public NodeTest {
 protected:
  /// Five frames: the first cannot initialize, the fourth is black. Returns the stamps of the
  /// trajectory.
  std::vector<double> saveFiveFrames() {
    const TemporaryFolder folder;
    publishCameraOnBase();
    setParameter("trajectory_folder", folder.path());
    load();
    spoil_ = [this] {
      const ros::Time stamp = next_color_.header.stamp;
      if (stamp == stampOf(0) || stamp == stampOf(3)) blacken();
    };
    for (int i = 0; i < 5; ++i) track(i);
    EXPECT_EQ(TrackingStatus::INITIALIZING, statusOf(0).state);
    EXPECT_EQ(TrackingStatus::LOST, statusOf(3).state);
    SaveTrajectory call;
    call.request.path = folder / "trajectory.txt";
    EXPECT_TRUE(ros::service::call(privateName("save_trajectory"), call));
    std::vector<double> stamps;
    for (const StampedPose& pose : readTrajectory(call.request.path)) stamps.push_back(pose.stamp);
    EXPECT_EQ(stamps.size(), call.response.poses);
    return stamps;
  }

  std::vector<double> stampsOf(const std::vector<int>& frames) const {
    std::vector<double> stamps;
    for (const int i : frames) stamps.push_back(std::round(toSeconds(stampOf(i)) * 1e6) / 1e6);
    return stamps;
  }
};

TEST_F(LostFramesTest, TrajectoriesDoNotHaveThem) {
  EXPECT_EQ(stampsOf({1, 2, 4}), saveFiveFrames());
}

TEST_F(LostFramesTest, TrajectoriesHaveThemWhenAskedFor) {
  setParameter("write_lost", true);
  EXPECT_EQ(stampsOf({1, 2, 3, 4}), saveFiveFrames());
}

TEST_F(NodeTest, AResetIsWholeThoughItsTrajectoryCannotBeWritten) {
  const TemporaryFolder folder;
  publishCameraOnBase();
  setParameter("trajectory_folder", folder.path());
  setParameter("trajectory_file", "live.txt");
  load();  // its reset began the second file
  for (int i = 0; i < 5; ++i) track(i);
  std::ofstream(folder / "live_3.txt") << "of another run\n";
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call(privateName("reset"), reset));
  EXPECT_TRUE(reset.response.success) << reset.response.message;
  EXPECT_TRUE(waitFor([&] { return !paths_.empty() && paths_.back().poses.empty(); }));
  track(5);
  ASSERT_TRUE(waitFor([&] { return isDone(5); }));
  EXPECT_LT(poseError(5, Eigen::Isometry3d::Identity()), 1e-9);
  EXPECT_EQ("of another run\n", contentOf(folder / "live_3.txt"));
}

TEST_F(NodeTest, LiveChangesAreTakenWholeOrNotAtAll) {
  publishCameraOnBase();
  setParameter("levels", 4);
  load();
  track(0);
  dynamic_reconfigure::Reconfigure call;
  dynamic_reconfigure::IntParameter number;
  number.name = "mi_bins";
  number.value = 16;
  call.request.config.ints = {number};
  ASSERT_TRUE(ros::service::call(privateName("set_parameters"), call));
  EXPECT_EQ(16, ros::param::param(privateName("mi_bins"), 0));
  EXPECT_EQ(4, ros::param::param(privateName("levels"), 0));
  track(1);

  number.value = 12;
  dynamic_reconfigure::IntParameter wrong;
  wrong.name = "levels";
  wrong.value = 99;
  call.request.config.ints = {number, wrong};
  EXPECT_FALSE(ros::service::call(privateName("set_parameters"), call));
  EXPECT_EQ(16, ros::param::param(privateName("mi_bins"), 0));
  wrong.name = "no_such_name";
  call.request.config.ints = {number, wrong};
  EXPECT_FALSE(ros::service::call(privateName("set_parameters"), call));
  EXPECT_EQ(16, ros::param::param(privateName("mi_bins"), 0));
  track(2);
  EXPECT_EQ(TrackingStatus::TRACKING, statusOf(2).state);
}

TEST_F(NodeTest, AllParametersInEffectCanBeReadBack) {
  setParameter("max_depth", 8);  // a whole number for one with decimals
  setParameter("method", "mi");
  load();
  EXPECT_EQ(8.0, ros::param::param(privateName("max_depth"), 0.0));
  const Parameters read = readParameters(ros::NodeHandle(ns_ + "/odometry"));
  EXPECT_EQ(Method::kMi, read.alignment.method);
  for (const ParameterInfo& info : parameterTable()) {
    EXPECT_TRUE(ros::param::has(privateName(info.name))) << info.name;
  }
}

TEST_F(NodeTest, WrongParametersLeaveTheNodeIdleAndTheManagerAlive) {
  setParameter("levels", 99);
  loadOnly();
  const auto status = diagnosis("tracking", [](const std::string& text) {
    return text.find("idle") == 0 && text.find("levels") != std::string::npos;
  });
  EXPECT_EQ(diagnostic_msgs::DiagnosticStatus::ERROR, status.level);
}

TEST_F(NodeTest, ParametersOfTheNodeAreChecked) {
  const ros::NodeHandle handle(ns_ + "/odometry");
  setParameter("queue_size", "many");
  EXPECT_ERROR(readNodeParameters(handle), "queue_size' is a string, expected a whole number");
  setParameter("queue_size", 0);
  EXPECT_ERROR(readNodeParameters(handle), "queue_size': 0 is not from 1");
  setParameter("queue_size", 10);
  setParameter("base_frame", "/odom");
  setParameter("odom_frame", "odom");
  EXPECT_ERROR(readNodeParameters(handle), "must differ");
  setParameter("base_frame", "base_link");
  setParameter("levels", "five");
  EXPECT_ERROR(readParameters(handle), "'levels': 'five' is not a whole number from");
  setParameter("levels", 5);
  setParameter("max_iteration", 5);
  setParameter("sub/group", 5);
  const auto unknown = findUnknownParameters(handle, nodeParameterNames());
  ASSERT_EQ(1U, unknown.size());
  EXPECT_NE(std::string::npos, unknown[0].find("max_iteration'")) << unknown[0];
  EXPECT_NE(std::string::npos, unknown[0].find("'max_iterations'")) << unknown[0];
  // Nothing is near this one.
  setParameter("no_such_parameter", 5);
  for (const std::string& fault : findUnknownParameters(handle, nodeParameterNames())) {
    EXPECT_EQ(fault.find("no_such_parameter") != std::string::npos,
              fault.find("did you mean") == std::string::npos)
        << fault;
  }
}

TEST_F(NodeTest, ParametersMeanWhatTheyDoInAConfigurationFile) {
  const ros::NodeHandle handle(ns_ + "/odometry");
  // As rosparam parses `min_cost_change: 1e-4` and quoted booleans.
  setParameter("min_cost_change", "1e-4");
  setParameter("geometric_term", "off");
  setParameter("levels", "4");
  setParameter("drop_frames", "yes");
  setParameter("publish_tf", 0);
  setParameter("tf_timeout", "2e-2");
  setParameter("queue_size", "20");
  const Parameters parameters = readParameters(handle);
  EXPECT_EQ("0.0001", getParameter(parameters, "min_cost_change"));
  EXPECT_EQ("false", getParameter(parameters, "geometric_term"));
  EXPECT_EQ("4", getParameter(parameters, "levels"));
  const NodeParameters node = readNodeParameters(handle);
  EXPECT_TRUE(node.drop_frames);
  EXPECT_FALSE(node.publish_tf);
  EXPECT_EQ(0.02, node.tf_timeout);
  EXPECT_EQ(20, node.queue_size);
}

TEST_F(NodeTest, UnloadingWhileFramesWaitEndsCleanly) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 40; ++i) publish(i);
  EXPECT_TRUE(unload());
  EXPECT_TRUE(waitFor([this] { return color_.getNumSubscribers() == 0; }));
  load();  // the manager is alive, and the name is free again
  EXPECT_TRUE(unload());
}

}  // namespace
}  // namespace mivo
