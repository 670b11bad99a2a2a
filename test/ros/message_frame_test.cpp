// SPDX-License-Identifier: BSD-3-Clause
#include "ros/message_frame.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "ros/camera_conversion.h"
#include "ros/expect_error.h"
#include "ros/status_conversion.h"

namespace mivo {
namespace {

sensor_msgs::Image makeImage(const std::string& encoding, std::uint32_t bytes) {
  sensor_msgs::Image image;
  image.header.stamp = ros::Time(12, 500000000);
  image.width = 32;
  image.height = 24;
  image.encoding = encoding;
  image.step = image.width * bytes;
  image.data.resize(image.step * image.height, 4);  // 16 bits: 0x0404, 1.028 m
  return image;
}

ImagePair makePair(const sensor_msgs::Image& color, const sensor_msgs::Image& depth,
                   std::uint32_t width = 32) {
  Camera camera;
  camera.width = static_cast<int>(width);
  camera.height = 24;
  camera.fx = camera.fy = 30.0;
  camera.cx = camera.cy = 12.0;
  return {wrap(boost::make_shared<sensor_msgs::Image>(color)),
          wrap(boost::make_shared<sensor_msgs::Image>(depth)),
          boost::make_shared<sensor_msgs::CameraInfo>(toCameraInfo(camera))};
}

TEST(ToFrameTest, StampPixelsAndCalibrationAreThoseOfTheMessages) {
  const ImagePair pair = makePair(makeImage("mono8", 1), makeImage("16UC1", 2));
  const MessageFrame input = FrameMaker(false).make(pair);
  EXPECT_EQ(12.5, input.frame.stamp);
  EXPECT_EQ(30.0, input.camera.fx);
  EXPECT_EQ(pair.color->raw->data.data(), input.frame.image.data);  // not copied
  EXPECT_EQ(pair.depth->raw->data.data(), input.frame.depth.data);
}

TEST(ToFrameTest, WhatDoesNotFitIsRefusedWithTheReason) {
  EXPECT_ERROR(FrameMaker(false).make(makePair(makeImage("mono8", 1), makeImage("16UC1", 2), 640)),
               "640");
  EXPECT_ERROR(FrameMaker(false).make(makePair(makeImage("16UC1", 2), makeImage("mono8", 1))),
               "16UC1");
  sensor_msgs::Image small = makeImage("16UC1", 2);
  small.height = 12;
  small.data.resize(small.step * small.height);
  EXPECT_ERROR(FrameMaker(false).make(makePair(makeImage("mono8", 1), small)), "register");
}

TEST(StatusTest, CodesAreThoseOfTheMessageDefinition) {
  TrackingResult result;
  const std::pair<TrackingState, int> states[] = {
      {TrackingState::kInitializing, TrackingStatus::INITIALIZING},
      {TrackingState::kTracking, TrackingStatus::TRACKING},
      {TrackingState::kDegraded, TrackingStatus::DEGRADED},
      {TrackingState::kLost, TrackingStatus::LOST}};
  for (const auto& [state, code] : states) {
    result.state = state;
    EXPECT_EQ(code, toMessage(result, {}).state);
    EXPECT_EQ(toString(state), toMessage(result, {}).state_text);
  }
  const std::pair<TrackingReason, int> reasons[] = {
      {TrackingReason::kNone, 0},           {TrackingReason::kInvalidFrame, 1},
      {TrackingReason::kTooFewPoints, 2},   {TrackingReason::kNoOverlap, 3},
      {TrackingReason::kOpenDirections, 4}, {TrackingReason::kImplausibleMotion, 5},
      {TrackingReason::kNotFinite, 6},      {TrackingReason::kNothingInCommon, 7},
      {TrackingReason::kStaleStamp, 8},     {TrackingReason::kAmbiguous, 9}};
  for (const auto& [reason, code] : reasons) {
    result.reason = reason;
    EXPECT_EQ(code, toMessage(result, {}).reason);
    EXPECT_EQ(toString(reason), toMessage(result, {}).reason_text);
  }
}

TEST(StatusTest, OpenDirectionsAreTheTrackersInItsOrder) {
  TrackingResult result;
  result.reason = TrackingReason::kOpenDirections;
  result.open_directions = {true, false, false, false, true, false};
  const TrackingStatus message = toMessage(result, {});
  for (std::size_t i = 0; i < message.open_directions.size(); ++i) {
    EXPECT_EQ(result.open_directions[i], message.open_directions[i] != 0) << i;
  }
  EXPECT_EQ(describeReason(result), message.reason_text);
}

TEST(StatusTest, TheWayOfTheFrameIsTold) {
  FrameAccount account;
  account.header.frame_id = "optical";
  account.frames = 1;
  account.skipped_frames = 2;
  account.dropped_frames = 3;
  account.conversion_cpu_ms = 4.0;
  account.pairing_offset = 5.0;
  account.latency = 6.0;
  account.processing_latency = 7.0;
  const TrackingStatus message = toMessage(TrackingResult(), account);
  EXPECT_EQ("optical", message.header.frame_id);
  EXPECT_EQ(1U, message.frames);
  EXPECT_EQ(2U, message.skipped_frames);
  EXPECT_EQ(3U, message.dropped_frames);
  EXPECT_EQ(4.0, message.conversion_cpu_ms);
  EXPECT_EQ(5.0, message.pairing_offset);
  EXPECT_EQ(6.0, message.latency);
  EXPECT_EQ(7.0, message.processing_latency);
}

TEST(StatusTest, TheShutterIsTold) {
  TrackingResult result;
  result.rolling_shutter_readout = 0.02;
  result.depth_time_offset = -0.01;
  const TrackingStatus message = toMessage(result, {});
  EXPECT_EQ(0.02, message.rolling_shutter_readout);
  EXPECT_EQ(-0.01, message.depth_time_offset);
}

TEST(StatusTest, LevelsKeepTheirOrder) {
  TrackingResult result;
  result.num_levels = 2;
  result.levels[0].level = 4;
  result.levels[0].mutual_information = true;
  result.levels[1].level = 3;
  result.levels[1].iterations = 7;
  const TrackingStatus message = toMessage(result, {});
  ASSERT_EQ(2U, message.levels.size());
  EXPECT_EQ(4, message.levels[0].level);
  EXPECT_TRUE(message.levels[0].mutual_information);
  EXPECT_EQ(7, message.levels[1].iterations);
}

}  // namespace
}  // namespace mivo
