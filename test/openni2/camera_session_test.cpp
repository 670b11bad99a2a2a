// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/camera_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "fake_camera.h"

namespace mivo {
namespace {

using std::chrono::milliseconds;

class CameraSessionTest : public ::testing::Test, public CameraListener {
 public:
  void onImage(const ImageView& image, std::int64_t stamp) override {
    if (!image_error_.empty()) {
      ++refused_images_;
      throw std::runtime_error(image_error_);
    }
    ++images_[image.kind];
    stamps_.push_back(stamp);
  }
  void onMessage(Severity severity, const std::string& line) override {
    if (!message_error_.empty()) {
      throw std::runtime_error(message_error_);
    }
    messages_.push_back(line);
    errors_ += severity == Severity::kError ? 1 : 0;
  }
  void onDevice(const DeviceDescription& /*device*/) override { ++devices_; }
  void onSettings(const CameraSettings& settings) override { reported_ = settings; }

 protected:
  CameraSession& session() {
    if (!session_) {
      session_ = std::make_unique<CameraSession>(
          DeviceRequest{}, SessionTimes{}, fakeFactory(world_),
          [this] {
            return std::chrono::duration_cast<std::chrono::nanoseconds>(now_.time_since_epoch())
                .count();
          },
          *this);
    }
    return *session_;
  }

  // Steps as the thread does, with a simulated clock: sleeping takes no time.
  void runFor(milliseconds duration) {
    const auto end = now_ + duration;
    while (now_ < end) {
      const std::uint64_t before = world_.time;
      const milliseconds pause = session().step(now_);
      now_ += pause.count() > 0 ? std::min<CameraSession::Time::duration>(pause, end - now_)
                                : std::chrono::microseconds(world_.time - before);
      ++steps_;
    }
  }

  bool heard(const std::string& part) const {
    for (const std::string& message : messages_) {
      if (message.find(part) != std::string::npos) {
        return true;
      }
    }
    return false;
  }

  FakeCameraWorld world_;
  CameraSession::Time now_{std::chrono::hours(1)};
  std::map<StreamKind, int> images_;
  std::vector<std::int64_t> stamps_;
  std::vector<std::string> messages_;
  std::string image_error_;    // thrown instead of taking an image
  std::string message_error_;  // thrown instead of taking a message
  int refused_images_ = 0;
  int errors_ = 0;
  int devices_ = 0;
  int steps_ = 0;
  std::optional<CameraSettings> reported_;
  std::unique_ptr<CameraSession> session_;
};

TEST_F(CameraSessionTest, WhatTheListenerThrowsIsToldOnceAndTheCameraGoesOn) {
  session().setDemand({true, false});
  runFor(milliseconds(1000));
  image_error_ = "no memory for the message";
  runFor(milliseconds(1000));
  EXPECT_GT(refused_images_, 20);
  EXPECT_TRUE(heard("no memory for the message"));
  EXPECT_EQ(errors_, 1);
  EXPECT_EQ(session().status().listener_fault, image_error_);
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
  EXPECT_EQ(devices_, 1);
  const int before = images_[StreamKind::kColor];
  image_error_.clear();
  runFor(milliseconds(1000));
  EXPECT_GT(images_[StreamKind::kColor], before + 20);
}

TEST_F(CameraSessionTest, AListenerThatCannotEvenBeToldDoesNotEndTheSession) {
  message_error_ = "the log is closed";
  session().setDemand({true, false});
  runFor(milliseconds(1000));
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
  EXPECT_EQ(session().status().listener_fault, "the log is closed");
  EXPECT_GT(images_[StreamKind::kColor], 5);
}

TEST_F(CameraSessionTest, AnUnexpectedErrorOfTheDeviceIsToldAndTheDeviceOpenedAgain) {
  session().setDemand({true, false});
  runFor(milliseconds(1000));
  world_.read_error = "vector::reserve";
  runFor(milliseconds(100));
  EXPECT_EQ(session().status().state, CameraState::kWaiting);
  EXPECT_EQ(session().status().fault, DeviceFault::kUnexpected);
  EXPECT_TRUE(heard("vector::reserve"));
  EXPECT_EQ(world_.open_devices, 0);
  world_.read_error.clear();
  runFor(milliseconds(2000));
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
  EXPECT_EQ(session().status().reconnections, 1);
}

TEST_F(CameraSessionTest, NoStreamWithoutDemand) {
  runFor(milliseconds(3000));
  EXPECT_EQ(session().status().state, CameraState::kIdle);
  EXPECT_EQ(devices_, 1);
  EXPECT_TRUE(world_.calls.empty());
  EXPECT_LT(steps_, 10) << "an idle camera is looked after twice a second";
}

TEST_F(CameraSessionTest, DemandStartsAndStopsEachStreamByItself) {
  runFor(milliseconds(100));
  session().setDemand({true, false});
  runFor(milliseconds(1000));
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
  EXPECT_GE(images_[StreamKind::kColor], 9);
  EXPECT_EQ(images_[StreamKind::kDepth], 0);
  session().setDemand({true, true});
  runFor(milliseconds(1000));
  EXPECT_GT(images_[StreamKind::kDepth], 10);
  session().setDemand({false, true});
  runFor(milliseconds(100));
  session().setDemand({false, false});
  runFor(milliseconds(100));
  EXPECT_EQ(world_.calls,
            (std::vector<std::string>{"start color", "start depth", "stop color", "stop depth"}));
  EXPECT_EQ(session().status().state, CameraState::kIdle);
}

TEST_F(CameraSessionTest, WarmUpIsHeldBackForCamerasAndNotForRecordings) {
  session().setDemand({true, false});
  runFor(milliseconds(1000));
  EXPECT_EQ(world_.images - images_[StreamKind::kColor], 19)
      << "ten in any case; the clocks are known with the twentieth";

  session_.reset();
  world_ = FakeCameraWorld{};
  world_.is_recording = true;
  images_.clear();
  session().setDemand({true, false});
  runFor(milliseconds(1000));
  EXPECT_EQ(images_[StreamKind::kColor], world_.images);
}

TEST_F(CameraSessionTest, AbsentCameraIsTriedWithGrowingPausesAndReportedOnce) {
  world_.open_fault = DeviceFault::kNoDevice;
  session().setDemand({true, true});
  runFor(milliseconds(60000));
  // 0, 0.5, 1.5, 3.5, 7.5, 15.5, 23.5, ... 55.5 s
  EXPECT_EQ(world_.open_attempts, 11);
  EXPECT_EQ(errors_, 1);
  EXPECT_TRUE(heard("The fake camera does not open. Plug the camera in"));
  EXPECT_EQ(session().status().state, CameraState::kWaiting);
  EXPECT_EQ(session().status().fault, DeviceFault::kNoDevice);
  EXPECT_LT(steps_, 40);

  world_.open_fault = DeviceFault::kInUse;
  runFor(milliseconds(9000));
  EXPECT_EQ(errors_, 2) << "another fault is news";
  world_.open_fault.reset();
  runFor(milliseconds(10000));
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
  EXPECT_EQ(session().status().failures, 0);
  EXPECT_TRUE(heard("Fake Camera (fake://0) is open"));
}

TEST_F(CameraSessionTest, UnpluggedCameraIsOpenedAgainAndGoesOn) {
  session().setDemand({true, true});
  runFor(milliseconds(2000));
  const int before = images_[StreamKind::kColor];
  world_.connected = false;
  world_.open_fault = DeviceFault::kNoDevice;
  runFor(milliseconds(3000));
  EXPECT_EQ(world_.open_devices, 0);
  EXPECT_TRUE(heard("Fake Camera was unplugged"));
  world_.connected = true;
  world_.open_fault.reset();
  world_.time = 0;  // its clock restarts
  runFor(milliseconds(6000));
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
  EXPECT_EQ(session().status().reconnections, 1);
  EXPECT_FALSE(session().status().fault.has_value());
  EXPECT_GT(images_[StreamKind::kColor], before + 30);
}

TEST_F(CameraSessionTest, UnpluggedIdleCameraIsNoticedToo) {
  runFor(milliseconds(1000));
  world_.connected = false;
  runFor(milliseconds(1000));
  EXPECT_EQ(session().status().fault, DeviceFault::kLost);
}

TEST_F(CameraSessionTest, StreamThatFallsSilentIsALoss) {
  session().setDemand({true, true});
  runFor(milliseconds(1000));
  world_.silent[static_cast<std::size_t>(StreamKind::kDepth)] = true;
  runFor(milliseconds(1800));
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
  runFor(milliseconds(500));
  EXPECT_EQ(session().status().fault, DeviceFault::kLost);
  EXPECT_TRUE(heard("delivers no depth any more"));
}

TEST_F(CameraSessionTest, StreamThatNeverDeliversBacksOffToo) {
  world_.silent = {true, true};
  session().setDemand({true, true});
  runFor(milliseconds(120000));
  EXPECT_TRUE(heard("though the stream was started"));
  EXPECT_TRUE(heard(adviceFor(DeviceFault::kUsb)));
  // Each attempt takes 5 s and the pauses double to 8 s: opening alone must not count as success.
  EXPECT_LE(world_.open_attempts, 14);
  EXPECT_GE(session().status().failures, 5);
}

TEST_F(CameraSessionTest, SettingsAreAppliedAfterTheFirstImageAndReadBack) {
  CameraSettings settings;
  settings.auto_exposure = false;
  settings.exposure = 20;
  session().setSettings(settings);
  session().setDemand({true, false});
  runFor(milliseconds(1000));
  EXPECT_EQ(world_.images_before_settings, 1);
  EXPECT_EQ(world_.settings, settings);
  ASSERT_TRUE(reported_.has_value());
  EXPECT_EQ(*reported_, settings);

  settings.exposure = 40;
  session().setSettings(settings);
  runFor(milliseconds(100));
  EXPECT_EQ(world_.settings.exposure, 40);
}

TEST_F(CameraSessionTest, CameraThatIgnoresSettingsIsNamed) {
  world_.deaf = true;
  world_.settings.exposure = 33;
  CameraSettings settings;
  settings.exposure = 20;
  session().setSettings(settings);
  session().setDemand({true, false});
  runFor(milliseconds(1000));
  EXPECT_TRUE(heard("exposure stays 33 instead of 20"));
  ASSERT_TRUE(reported_.has_value());
  EXPECT_EQ(reported_->exposure, 33);
}

TEST_F(CameraSessionTest, HalfTheRateIsReportedOnceAndSoIsItsEnd) {
  session().setDemand({true, false});
  world_.skip = 2;
  runFor(milliseconds(5000));
  EXPECT_TRUE(heard("delivers 15.0 color images per second instead of 30"));
  EXPECT_TRUE(session().status().slow);
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
  EXPECT_NEAR(session().status().streams[0].rate, 15.0, 0.1);
  const auto count = messages_.size();
  runFor(milliseconds(5000));
  EXPECT_EQ(messages_.size(), count);
  world_.skip = 1;
  runFor(milliseconds(8000));
  EXPECT_TRUE(heard("full rate again"));
  EXPECT_FALSE(session().status().slow);
}

TEST_F(CameraSessionTest, RecordingEndsOnceAndPlaysAgainForTheNextSubscriber) {
  world_.is_recording = true;
  session().setDemand({true, true});
  runFor(milliseconds(2000));
  world_.silent = {true, true};
  runFor(milliseconds(4000));
  EXPECT_EQ(session().status().state, CameraState::kEnded);
  EXPECT_EQ(errors_, 0);
  EXPECT_EQ(world_.open_attempts, 1);
  world_.silent = {};
  session().setDemand({false, false});
  session().setDemand({true, true});
  runFor(milliseconds(1000));
  EXPECT_EQ(session().status().state, CameraState::kStreaming);
}

TEST_F(CameraSessionTest, RecordingThatNeverDeliversIsBad) {
  world_.is_recording = true;
  world_.silent = {true, true};
  session().setDemand({true, true});
  runFor(milliseconds(5300));
  EXPECT_EQ(session().status().fault, DeviceFault::kBadRecording);
}

}  // namespace
}  // namespace mivo
