// SPDX-License-Identifier: BSD-3-Clause
// A recording made of the virtual camera plays back equal through the same class.

#include <OpenNI.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "mivo/openni2/openni2_device.h"
#include "virtual_xtion_fixture.h"

namespace mivo {
namespace {

constexpr unsigned kWatchdog = 60;  // s: the SDK's recorder is known to lock up

class RecordingTest : public VirtualXtionTest {
 protected:
  void SetUp() override {
    alarm(kWatchdog);
    VirtualXtionTest::SetUp();
  }
  void TearDown() override {
    VirtualXtionTest::TearDown();
    alarm(0);
  }

  static openni::VideoMode mode(openni::PixelFormat format) {
    openni::VideoMode mode;
    mode.setResolution(640, 480);
    mode.setFps(30);
    mode.setPixelFormat(format);
    return mode;
  }

  // Records until the sequence is over; returns the number of colour images seen meanwhile.
  void record(const std::string& path) {
    ASSERT_EQ(openni::OpenNI::initialize(), openni::STATUS_OK);
    {
      openni::Device device;
      ASSERT_EQ(device.open("virtual_xtion://0"), openni::STATUS_OK);
      openni::VideoStream color;
      openni::VideoStream depth;
      ASSERT_EQ(color.create(device, openni::SENSOR_COLOR), openni::STATUS_OK);
      ASSERT_EQ(depth.create(device, openni::SENSOR_DEPTH), openni::STATUS_OK);
      color.setVideoMode(mode(openni::PIXEL_FORMAT_RGB888));
      depth.setVideoMode(mode(openni::PIXEL_FORMAT_DEPTH_1_MM));
      color.setMirroringEnabled(false);
      depth.setMirroringEnabled(false);
      device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
      device.setDepthColorSyncEnabled(true);
      openni::Recorder recorder;
      ASSERT_EQ(recorder.create(path.c_str()), openni::STATUS_OK);
      ASSERT_EQ(recorder.attach(color), openni::STATUS_OK);
      ASSERT_EQ(recorder.attach(depth), openni::STATUS_OK);
      ASSERT_EQ(recorder.start(), openni::STATUS_OK);
      color.start();
      depth.start();
      play();
      openni::VideoStream* streams[] = {&color, &depth};
      int ready = 0;
      for (int images = 0; images < 2 * (kFrames + 12); ++images) {
        ASSERT_EQ(openni::OpenNI::waitForAnyStream(streams, 2, &ready, 2000), openni::STATUS_OK);
        openni::VideoFrameRef frame;
        streams[ready]->readFrame(&frame);
      }
      // The streams first: stopping a recorder under running streams can lock up for ever.
      color.stop();
      depth.stop();
      recorder.stop();
      recorder.destroy();
      color.destroy();
      depth.destroy();
    }
    openni::OpenNI::shutdown();
  }
};

TEST_F(RecordingTest, PlaysBackEqualAndThenFallsSilent) {
  const std::string path = folder_ + "/recording.oni";
  record(path);
  ASSERT_FALSE(HasFatalFailure());
  control("present", 0);  // the recording needs no camera

  DeviceRequest request;
  request.address = path;
  const auto device = OpenNi2Device::open(request);
  EXPECT_TRUE(device->description().is_recording);
  EXPECT_NEAR(device->description().color_field_of_view, 2.0 * std::atan(320.0 / 525.0), 1e-6);
  device->start(StreamKind::kColor);
  device->start(StreamKind::kDepth);
  std::map<StreamKind, std::vector<bool>> seen{{StreamKind::kColor, std::vector<bool>(kFrames)},
                                               {StreamKind::kDepth, std::vector<bool>(kFrames)}};
  std::map<StreamKind, std::uint64_t> last;
  int unknown = 0;
  int silent = 0;
  while (silent < 5) {
    const bool came = device->read(std::chrono::milliseconds(200), [&](const ImageView& view) {
      const bool is_color = view.kind == StreamKind::kColor;
      const cv::Mat image(view.height, view.width, is_color ? CV_8UC3 : CV_16UC1,
                          const_cast<std::uint8_t*>(view.data), view.stride);
      int i = 0;
      while (i < kFrames &&
             cv::norm(image, is_color ? colorImage(i) : depthImage(i), cv::NORM_INF) != 0.0) {
        ++i;
      }
      if (i < kFrames) {
        seen[view.kind][static_cast<std::size_t>(i)] = true;
      } else {
        ++unknown;
      }
      if (last.count(view.kind) != 0) {
        EXPECT_GT(view.device_stamp, last[view.kind]);
      }
      last[view.kind] = view.device_stamp;
    });
    silent = came ? 0 : silent + 1;
  }
  EXPECT_EQ(unknown, 0);
  // The player drops what is not fetched in time; comparing takes longer than an image lasts.
  EXPECT_GE(std::count(seen[StreamKind::kColor].begin(), seen[StreamKind::kColor].end(), true), 3);
  EXPECT_GE(std::count(seen[StreamKind::kDepth].begin(), seen[StreamKind::kDepth].end(), true), 3);
  EXPECT_TRUE(seen[StreamKind::kColor][kFrames - 1]);
}

}  // namespace
}  // namespace mivo
