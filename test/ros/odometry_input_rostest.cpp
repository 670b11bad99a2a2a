// SPDX-License-Identifier: BSD-3-Clause
// What the odometry nodelet does with messages that are broken, late, early, missing or compressed.
#include <gtest/gtest.h>
#include <sensor_msgs/CompressedImage.h>

#include <opencv2/imgcodecs.hpp>

#include "mivo/core/se3.h"
#include "mivo/ros/image_conversion.h"
#include "mivo/ros/pose_conversion.h"
#include "programs/plane_sequence.h"
#include "ros/node_fixture.h"

namespace mivo {
namespace {

constexpr double kTolerance = 0.006;  // as in odometry_rostest

TEST_F(NodeTest, UnusableMessagesAreSkippedWithTheReason) {
  publishCameraOnBase();
  load();
  track(0);
  const sensor_msgs::CameraInfo good = calibration_;
  const std::pair<const char*, std::function<void()>> faults[] = {
      {"equidistant", [this] { calibration_.distortion_model = "equidistant"; }},
      {"640", [this] { calibration_.width = 640; }},
      {"'rgb16'", [this] { next_colour_.encoding = "rgb16"; }},
      {"step", [this] { next_depth_.step = 3; }},
      {"not calibrated", [this] { calibration_.K.fill(0.0); }}};
  int at = 1;
  for (const auto& [reason, fault] : faults) {
    spoil_ = fault;
    const std::string wanted = reason;
    const auto told = [&](const std::string& text) {
      return text.find(wanted) != std::string::npos;
    };
    // The calibration comes on a connection of its own and may be later than the first images.
    while (!hasDiagnosis("input", told) && at < 100) publish(at, at), ++at;
    EXPECT_TRUE(hasDiagnosis("input", told)) << reason;
    calibration_ = good;
  }
  spoil_ = [] {};
  track(at);
  EXPECT_GE(statuses_[stampOf(at)].skipped_frames, 5U);
  EXPECT_EQ(TrackingStatus::TRACKING, statuses_[stampOf(at)].state);
  ASSERT_TRUE(waitFor([&] { return hasOdometry(at); }));
  EXPECT_LT(poseError(at, truth(at)), kTolerance);
}

TEST_F(NodeTest, FramesWithoutDepthAreLeftOut) {
  publishCameraOnBase();
  load();
  spoil_ = [this] {
    if (next_colour_.header.stamp == stampOf(3)) next_depth_.header.stamp += ros::Duration(-60.0);
  };
  for (int i = 0; i < 8; ++i) publish(i);
  ASSERT_TRUE(waitFor([&] { return hasOdometry(7); }));
  EXPECT_FALSE(hasStatus(3));
  EXPECT_EQ(7U, statuses_.size());
  EXPECT_LT(poseError(7, truth(7)), kTolerance);
}

TEST_F(NodeTest, NoFrameIsLostAlsoNotTheLastOne) {
  publishCameraOnBase();
  load();
  // Stamps differ, so that each pair could still get a better partner, the last one as well.
  for (int i = 0; i < 30; ++i) publish(i, i, 0.004);
  ASSERT_TRUE(waitFor([&] { return statuses_.size() == 30U && odometries_.size() == 30U; }))
      << statuses_.size();
  EXPECT_NEAR(0.004, statuses_[stampOf(29)].pairing_offset, 1e-6);
  EXPECT_EQ(0U, statuses_[stampOf(29)].dropped_frames);
}

TEST_F(NodeTest, ImagesThatWaitForTheCalibrationAreNotLost) {
  publishCameraOnBase();
  load();
  ASSERT_TRUE(unload());
  loadOnly();
  ASSERT_TRUE(waitFor(
      [this] { return colour_.getNumSubscribers() > 0 && depth_.getNumSubscribers() > 0; }));
  camera_info_.shutdown();
  for (int i = 0; i < 5; ++i) publish(i);
  diagnosis("tracking", [](const std::string& text) { return text == "no frames"; });
  camera_info_ = node_.advertise<sensor_msgs::CameraInfo>("rgb/camera_info", 1, true);
  camera_info_.publish(calibration_);
  // Which of the first messages reach this node is up to the connections; the last one does.
  ASSERT_TRUE(waitFor([&] { return hasStatus(4); }));
  EXPECT_EQ(5U, statuses_[stampOf(4)].frames);
}

TEST_F(NodeTest, DoubledAndLateStampsAreDroppedAndCounted) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 5; ++i) track(i);
  for (const int late : {4, 2, 3}) publish(late, late);
  publish(5);
  ASSERT_TRUE(waitFor([&] { return hasOdometry(5); }));
  EXPECT_EQ(6U, statuses_[stampOf(5)].frames);
  EXPECT_GE(statuses_[stampOf(5)].skipped_frames, 1U);
  EXPECT_LT(poseError(5, truth(5)), kTolerance);
}

TEST_F(NodeTest, AJumpBackOfTimeGoesOnAtTheLastPose) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 5; ++i) track(i, i + 60);  // two seconds later
  const int segment = statuses_[stampOf(64)].segment;
  for (int i = 4; i < 9; ++i) track(i, i);  // the bag from the start again
  ASSERT_TRUE(waitFor([&] { return hasOdometry(8); }));
  EXPECT_EQ(segment + 1, statuses_[stampOf(4)].segment);
  EXPECT_EQ(segment + 1, statuses_[stampOf(8)].segment);
  EXPECT_LT(poseError(4, truth(4)), kTolerance);
  EXPECT_LT(poseError(8, truth(8)), kTolerance);
}

TEST_F(NodeTest, AnotherCalibrationStartsAnewAtTheLastPose) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 4; ++i) track(i);
  calibration_.K[0] += 1.0;
  track(3, 4);
  EXPECT_EQ(statuses_[stampOf(3)].segment + 1, statuses_[stampOf(4)].segment);
  ASSERT_TRUE(waitFor([&] { return hasOdometry(4); }));
  EXPECT_LT(poseError(4, truth(3)), kTolerance);
}

TEST_F(NodeTest, SilentTopicsAreDiagnosed) {
  publishCameraOnBase();
  load();
  diagnosis("tracking", [](const std::string& text) { return text == "no frames"; });
}

TEST_F(NodeTest, CompressedImagesAreDecodedWithoutPlugins) {
  publishCameraOnBase();
  setParameter("rgb_transport", "compressed");
  setParameter("depth_transport", "compressedDepth");
  ros::Publisher colour =
      node_.advertise<sensor_msgs::CompressedImage>("rgb/image/compressed", 100);
  ros::Publisher depth =
      node_.advertise<sensor_msgs::CompressedImage>("depth/image/compressedDepth", 100);
  loadOnly();
  const auto connected = [&] {
    return colour.getNumSubscribers() > 0 && depth.getNumSubscribers() > 0 &&
           camera_info_.getNumSubscribers() > 0;
  };
  ASSERT_TRUE(waitFor(connected));
  spoil_ = [&] {
    sensor_msgs::CompressedImage message;
    message.header = next_colour_.header;
    message.format = "mono8; png compressed ";
    cv::imencode(".png", toGreyImage(next_colour_), message.data);
    colour.publish(message);
    message.header = next_depth_.header;
    message.format = "16UC1; compressedDepth";
    cv::Mat millimetres;
    toDepthImage(next_depth_).image.convertTo(millimetres, CV_16U, 1000.0);
    std::vector<std::uint8_t> png;
    cv::imencode(".png", millimetres, png);
    message.data.assign(12, 0);
    message.data.insert(message.data.end(), png.begin(), png.end());
    depth.publish(message);
  };
  // The first frames may come before this test's subscribers are connected.
  int i = 0;
  for (; i < 60 && !holds([&] { return odometries_.size() > 5U; }); ++i) {
    publish(i);
    waitFor([&] { return hasOdometry(i); }, std::chrono::milliseconds(200));
  }
  ASSERT_TRUE(waitFor([&] { return hasOdometry(i - 1); }));
  // odom began at the first frame.
  EXPECT_LT(poseError(i - 1, truth(i - 1)), kTolerance);
}

TEST_F(NodeTest, UnknownTransportsLeaveTheNodeIdleAndTheManagerAlive) {
  setParameter("rgb_transport", "pigeon");
  loadOnly();
  diagnosis("tracking", [](const std::string& text) {
    return text.find("idle") == 0 && text.find("pigeon") != std::string::npos;
  });
}

}  // namespace
}  // namespace mivo

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "odometry_input_rostest");
  return RUN_ALL_TESTS();
}
