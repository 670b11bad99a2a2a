// SPDX-License-Identifier: BSD-3-Clause
// The odometry nodelet with messages that are broken, late, early, missing or compressed.
#include <gtest/gtest.h>
#include <mivo/SaveTrajectory.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/CompressedImage.h>

#include <algorithm>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "mivo/core/se3.h"
#include "programs/plane_sequence.h"
#include "ros/image_conversion.h"
#include "ros/node_fixture.h"
#include "ros/pose_conversion.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

constexpr double kTolerance = 0.006;  // as in odometry_rostest

TEST_F(NodeTest, UnusableMessagesAreSkippedWithTheReason) {
  publishCameraOnBase();
  load();
  track(0);
  ASSERT_TRUE(waitFor([&] { return isDone(0); }));
  const sensor_msgs::CameraInfo good = calibration_;
  const std::pair<const char*, std::function<void()>> faults[] = {
      {"thin_prism",
       [this] {
         calibration_.distortion_model = "thin_prism";
         calibration_.D.assign(5, 0.1);
       }},
      {"640", [this] { calibration_.width = 640; }},
      {"'hsv8'", [this] { next_color_.encoding = "hsv8"; }},
      {"step", [this] { next_depth_.step = 3; }},
      {"not calibrated", [this] { calibration_.K.fill(0.0); }}};
  int at = 0;
  diagnostic_msgs::DiagnosticStatus found;
  for (const auto& [reason, fault] : faults) {
    spoil_ = fault;
    const std::string wanted = reason;
    at = publishUntil(
        [&] {
          return findDiagnosis(
              "input",
              [&](const std::string& text) { return text.find(wanted) != std::string::npos; },
              found);
        },
        0, at + 1);
    calibration_ = good;
  }
  spoil_ = [] {};
  const ros::Time good_from = stampOf(at + 1);
  at = publishUntil([&] { return odometries_.rbegin()->first >= good_from; }, 1, at + 1);
  ASSERT_TRUE(waitFor([&] { return isDone(at); }));
  EXPECT_GE(statusOf(at).skipped_frames, 5U);
  EXPECT_EQ(TrackingStatus::TRACKING, statusOf(at).state);
  EXPECT_LT(poseError(at, truth(1)), kTolerance);
}

TEST_F(NodeTest, FramesWithoutDepthAreLeftOut) {
  publishCameraOnBase();
  load();
  spoil_ = [this] { has_depth_ = next_color_.header.stamp != stampOf(3); };
  for (int i = 0; i < 8; ++i) publish(i);
  ASSERT_TRUE(waitFor([&] { return isDone(7); }));
  EXPECT_TRUE(holds([&] { return !hasStatus(3); }));
  EXPECT_TRUE(holds([&] { return statuses_.size() == 7U; }));
  EXPECT_LT(poseError(7, truth(7)), kTolerance);
}

TEST_F(NodeTest, NoFrameIsLostAlsoNotTheLastOne) {
  publishCameraOnBase();
  load();
  // Stamps differ, so that each pair could still get a better partner, the last one as well.
  for (int i = 0; i < 30; ++i) publish(i, i, 0.004);
  ASSERT_TRUE(waitFor([&] { return statuses_.size() == 30U && odometries_.size() == 30U; }))
      << statuses_.size();
  EXPECT_NEAR(0.004, statusOf(29).pairing_offset, 1e-6);
  EXPECT_EQ(0U, statusOf(29).dropped_frames);
}

TEST_F(NodeTest, LiveTheNewestFrameWinsAndTheOthersAreCounted) {
  constexpr int kFrames = 30;
  publishCameraOnBase();
  setParameter("drop_frames", true);
  setParameter("queue_size", 100);
  // A slow tracker: before each frame it waits for a transform that never comes.
  setParameter("guess_frame_id", frame("nowhere"));
  setParameter("tf_timeout", 0.2);
  setParameter("publish_tf", false);
  load();
  track(0);
  const TrackingStatus before = statusOf(0);
  for (int i = 1; i < kFrames; ++i) publish(i);
  ASSERT_TRUE(waitFor([&] { return isDone(kFrames - 1); }));
  const TrackingStatus after = statusOf(kFrames - 1);
  EXPECT_GT(after.dropped_frames, before.dropped_frames);
  EXPECT_EQ(kFrames - 1U, after.frames + after.dropped_frames + after.skipped_frames -
                              (before.frames + before.dropped_frames + before.skipped_frames));
  const std::string dropped = std::to_string(after.dropped_frames);
  EXPECT_TRUE(
      waitFor([&] { return valueOf(latestDiagnosis("input"), "dropped frames") == dropped; }));
}

TEST_F(NodeTest, LiveAPairIsNotHeldBackForTheNextImage) {
  publishCameraOnBase();
  setParameter("drop_frames", true);
  load();
  // At first a pair waits for the next image, which could fit better; then the period is known.
  constexpr int kLast = 20;
  constexpr double kDelay = 0.012;
  int i = 0;
  for (publish(i, i, kDelay); i < kLast; ++i) {
    publish(i + 1, i + 1, kDelay);
    // Images that overtake each other make two pairs at once, of which the newer one wins.
    ASSERT_TRUE(waitFor([&] {
      return !statuses_.empty() && statuses_.rbegin()->first >= stampOf(i);
    })) << i;
  }
  ASSERT_TRUE(waitFor([&] { return isDone(kLast); }));
  EXPECT_GT(statusOf(kLast).processing_latency, 0.0);
  // Without a next image, a pair is processed after half a second.
  EXPECT_LT(statusOf(kLast).processing_latency, 0.4);
}

TEST_F(NodeTest, ImagesThatWaitForTheCalibrationAreNotLost) {
  publishCameraOnBase();
  load();
  ASSERT_TRUE(unload());
  loadOnly();
  ASSERT_TRUE(
      waitFor([this] { return color_.getNumSubscribers() > 0 && depth_.getNumSubscribers() > 0; }));
  camera_info_.shutdown();
  for (int i = 0; i < 5; ++i) publish(i);
  diagnosis("tracking", [](const std::string& text) { return text == "no frames"; });
  camera_info_ = node_.advertise<sensor_msgs::CameraInfo>("rgb/camera_info", 1, true);
  camera_info_.publish(calibration_);
  // The first messages may be lost until topics are connected; the last one arrives.
  ASSERT_TRUE(waitFor([&] { return hasStatus(4); }));
  EXPECT_EQ(5U, statusOf(4).frames);
}

TEST_F(NodeTest, DoubledAndLateStampsAreRefusedAndCountedByReason) {
  const TemporaryFolder folder;
  publishCameraOnBase();
  setParameter("trajectory_folder", folder.path());
  load();
  for (int i = 0; i < 5; ++i) track(i);
  ASSERT_TRUE(waitFor([&] { return odometries_.size() == 5U; }));
  forget();
  for (const int late : {4, 2, 3}) publish(late, late);
  const std::string reason = "stamp is not newer than that of the frame before";
  ASSERT_TRUE(waitFor([&] { return hasStatus(4); }));  // the other two may not even be paired
  const TrackingStatus refused = statusOf(4);
  EXPECT_EQ(TrackingStatus::TRACKING, refused.state);  // of the frame before
  EXPECT_EQ(TrackingStatus::REASON_STALE_STAMP, refused.reason);
  EXPECT_EQ(reason, refused.reason_text);
  EXPECT_EQ(5U, refused.frames);
  publish(5);
  ASSERT_TRUE(waitFor([&] { return isDone(5); }));
  EXPECT_EQ(6U, statusOf(5).frames);
  EXPECT_EQ(TrackingStatus::REASON_NONE, statusOf(5).reason);
  EXPECT_TRUE(holds([&] { return odometries_.size() == 1U; }));
  EXPECT_LT(poseError(5, truth(5)), kTolerance);
  const std::string skipped = std::to_string(statusOf(5).skipped_frames);
  EXPECT_TRUE(waitFor([&] {
    const auto input = latestDiagnosis("input");
    return valueOf(input, "skipped: " + reason) == skipped &&
           valueOf(input, "skipped frames") == skipped;
  }));
  SaveTrajectory call;
  call.request.path = folder / "all.txt";
  ASSERT_TRUE(ros::service::call(privateName("save_trajectory"), call));
  EXPECT_EQ(6U, call.response.poses);
}

TEST_F(NodeTest, AJumpBackOfTimeGoesOnAtTheLastPose) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 5; ++i) track(i, i + 60);  // two seconds later
  const int segment = statusOf(64).segment;
  // The bag from the start again, with the camera where it was: four frames are skipped
  // until the jump is confirmed.
  for (int i = 0; i < 5; ++i) track(4, i);
  for (int i = 5; i < 9; ++i) track(i, i);
  ASSERT_TRUE(waitFor([&] { return isDone(8); }));
  EXPECT_EQ(TrackingStatus::REASON_STALE_STAMP, statusOf(3).reason);
  EXPECT_EQ(segment, statusOf(3).segment);
  EXPECT_EQ(segment + 1, statusOf(4).segment);
  EXPECT_EQ(segment + 1, statusOf(8).segment);
  EXPECT_LT(poseError(4, truth(4)), kTolerance);
  EXPECT_LT(poseError(8, truth(8)), kTolerance);
}

TEST_F(NodeTest, AlternatingStampsBeginNoSegment) {
  publishCameraOnBase();
  load();
  // Every second frame has the stamp of a second and a half before.
  for (int i = 0; i < 12; ++i) track(i, i % 2 == 1 ? i + 100 - 45 : i + 100);
  ASSERT_TRUE(waitFor([&] { return isDone(110); }));
  EXPECT_EQ(statusOf(100).segment, statusOf(110).segment);
  EXPECT_EQ(6U, statusOf(110).frames);
  EXPECT_LT(poseError(110, truth(10)), kTolerance);
}

TEST_F(NodeTest, StampsThatNeverMoveBeginNoSegment) {
  publishCameraOnBase();
  load();
  track(0, 50);
  for (int i = 0; i < 15; ++i) publish(i, 50);
  track(1, 51);
  ASSERT_TRUE(waitFor([&] { return isDone(51); }));
  EXPECT_EQ(statusOf(50).segment, statusOf(51).segment);
  EXPECT_EQ(2U, statusOf(51).frames);
}

TEST_F(NodeTest, AnotherCalibrationStartsAnewAtTheLastPose) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 4; ++i) track(i);
  const int segment = statusOf(3).segment;
  calibration_.K[0] += 1.0;
  const int at =
      publishUntil([&] { return statuses_.rbegin()->second.segment == segment + 1; }, 3, 4);
  ASSERT_TRUE(waitFor([&] { return isDone(at); }));
  EXPECT_LT(poseError(at, truth(3)), kTolerance);
}

TEST_F(NodeTest, ACalibrationThatChangesByRoundingStartsNothing) {
  publishCameraOnBase();
  load();
  const double focal = calibration_.K[0];
  for (int i = 0; i < 8; ++i) {
    calibration_.K[0] = focal + 1e-9 * (i % 2);
    track(i);
  }
  EXPECT_EQ(statusOf(0).segment, statusOf(7).segment);
}

TEST_F(NodeTest, ASilentTopicIsNamed) {
  publishCameraOnBase();
  load();
  std::vector<rosgraph_msgs::Log> log;
  const ros::Subscriber subscriber = collect("/rosout", log);
  has_depth_ = false;
  const std::string wanted = "no messages on: " + ns_ + "/depth/image";
  const auto is_told = [&] {
    return std::any_of(log.begin(), log.end(), [&](const rosgraph_msgs::Log& entry) {
      // The color topic is not named: its images come.
      return entry.msg.find(wanted + '\n') != std::string::npos;
    });
  };
  publishUntil(is_told, 0, 0);
  diagnosis("tracking", [](const std::string& text) { return text == "no frames"; });
}

TEST_F(NodeTest, CompressedImagesAreDecodedWithoutPlugins) {
  publishCameraOnBase();
  setParameter("rgb_transport", "compressed");
  setParameter("depth_transport", "compressedDepth");
  ros::Publisher color = node_.advertise<sensor_msgs::CompressedImage>("rgb/image/compressed", 100);
  ros::Publisher depth =
      node_.advertise<sensor_msgs::CompressedImage>("depth/image/compressedDepth", 100);
  loadOnly();
  const auto connected = [&] {
    return color.getNumSubscribers() > 0 && depth.getNumSubscribers() > 0 &&
           camera_info_.getNumSubscribers() > 0;
  };
  ASSERT_TRUE(waitFor(connected));
  spoil_ = [&] {
    sensor_msgs::CompressedImage message;
    message.header = next_color_.header;
    message.format = "mono8; png compressed ";
    cv::imencode(".png", toGrayImage(next_color_), message.data);
    color.publish(message);
    message.header = next_depth_.header;
    message.format = "16UC1; compressedDepth";
    cv::Mat millimeters;
    toDepthImage(next_depth_).image.convertTo(millimeters, CV_16U, 1000.0);
    std::vector<std::uint8_t> png;
    cv::imencode(".png", millimeters, png);
    message.data.assign(12, 0);
    message.data.insert(message.data.end(), png.begin(), png.end());
    depth.publish(message);
  };
  // The first frames may come before this test's subscribers are connected.
  int i = 0;
  const auto both_come = [&] { return odometries_.size() > 5U && statuses_.size() > 5U; };
  for (; i < 60 && !holds(both_come); ++i) {
    publish(i);
    waitFor([&] { return isDone(i); }, std::chrono::milliseconds(200));
  }
  ASSERT_TRUE(waitFor([&] { return isDone(i - 1); }));
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
