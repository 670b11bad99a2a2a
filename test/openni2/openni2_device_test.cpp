// SPDX-License-Identifier: BSD-3-Clause
// The camera through the real libOpenNI2, with the virtual driver in place of hardware.

#include "openni2/openni2_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "openni2_device_fixture.h"

namespace mivo {
namespace {

using std::chrono::milliseconds;

TEST_F(OpenNi2DeviceTest, OpensByEveryKindOfAddress) {
  control("devices", 2);
  EXPECT_EQ(OpenNi2Device::open(request(""))->description().uri, "virtual_xtion://0");
  EXPECT_EQ(OpenNi2Device::open(request("any"))->description().uri, "virtual_xtion://0");
  EXPECT_EQ(OpenNi2Device::open(request("#2"))->description().uri, "virtual_xtion://1");
  EXPECT_EQ(OpenNi2Device::open(request("VIRTUAL1"))->description().uri, "virtual_xtion://1");
  const auto device = OpenNi2Device::open(request("virtual_xtion://1"));
  EXPECT_EQ(device->description().serial, "VIRTUAL1");
  EXPECT_EQ(device->description().name, "mivo Virtual Xtion");
  EXPECT_FALSE(device->description().is_recording);
  EXPECT_TRUE(device->description().has_camera_settings);
  EXPECT_TRUE(device->description().notes.empty()) << device->description().notes.front();
  EXPECT_NEAR(device->description().color_field_of_view, 2.0 * std::atan(320.0 / 525.0), 1e-6);
}

TEST_F(OpenNi2DeviceTest, ImagesAreRegisteredSynchronousUnmirroredAndEqualToTheFiles) {
  const auto device = OpenNi2Device::open(request("any"));
  startBoth(*device);
  play();
  auto received = receive(*device, 25);
  int color_matches = 0;
  int previous = 0;
  for (const Received& color : received[StreamKind::kColor]) {
    for (int i = previous; i < kFrames; ++i) {
      if (same(color.image, colorImage(i))) {
        ++color_matches;
        previous = i;
        break;
      }
    }
  }
  EXPECT_EQ(color_matches, static_cast<int>(received[StreamKind::kColor].size()));
  EXPECT_EQ(previous, kFrames - 1) << "the sequence was not played to its end";
  int pairs = 0;
  for (const Received& depth : received[StreamKind::kDepth]) {
    EXPECT_EQ(depth.depth_unit, 0.001);
    for (const Received& color : received[StreamKind::kColor]) {
      if (color.stamp == depth.stamp) {
        ++pairs;
        EXPECT_EQ(color.index, depth.index);
        int i = 0;
        while (i < kFrames && !same(color.image, colorImage(i))) {
          ++i;
        }
        EXPECT_TRUE(same(depth.image, depthImage(i))) << i;
      }
    }
  }
  EXPECT_GT(pairs, 15);
}

TEST_F(OpenNi2DeviceTest, WithoutRegistrationDepthIsTheDepthCamerasOwn) {
  DeviceRequest unregistered = request("any");
  unregistered.registration = false;
  const auto device = OpenNi2Device::open(unregistered);
  startBoth(*device);
  const auto received = receive(*device, 1);
  EXPECT_FALSE(same(received.at(StreamKind::kDepth).front().image, depthImage(0)));
}

TEST_F(OpenNi2DeviceTest, DepthInTenthsOfMillimeters) {
  DeviceRequest fine = request("any");
  fine.depth_unit = 0.0001;
  const auto device = OpenNi2Device::open(fine);
  startBoth(*device);
  const auto received = receive(*device, 1);
  const Received& depth = received.at(StreamKind::kDepth).front();
  EXPECT_EQ(depth.depth_unit, 0.0001);
  EXPECT_EQ(depth.image.at<std::uint16_t>(100, 101),
            10 * depthImage(0).at<std::uint16_t>(100, 101));
}

TEST_F(OpenNi2DeviceTest, NothingPluggedIn) {
  control("present", 0);
  expectFault(request("any"), DeviceFault::kNoDevice, "No OpenNI2 camera is connected");
  expectFault(request("#1"), DeviceFault::kNoDevice, "There is no device #1");
  expectFault(request("1d27/0601@1/5"), DeviceFault::kNoDevice, "no device is connected");
}

TEST_F(OpenNi2DeviceTest, WrongAddressesNameWhatThereIs) {
  const std::string list = "connected: #1 virtual_xtion://0 (mivo Virtual Xtion)";
  expectFault(request("#2"), DeviceFault::kWrongAddress, list);
  expectFault(request("#0"), DeviceFault::kWrongAddress, list);
  expectFault(request("#x"), DeviceFault::kWrongAddress, list);
  expectFault(request("bogus://1"), DeviceFault::kWrongAddress, list);
  expectFault(request("1234567890"), DeviceFault::kWrongAddress, list);
  expectFault(request("/nowhere/a.oni"), DeviceFault::kWrongAddress,
              "There is no recording /nowhere/a.oni");
}

TEST_F(OpenNi2DeviceTest, FileThatIsNoRecording) {
  const std::string path = folder_ + "/broken.oni";
  std::ofstream(path) << "this is no recording";
  expectFault(request(path), DeviceFault::kBadRecording, path);
}

TEST_F(OpenNi2DeviceTest, TakenByAnotherProcess) {
  control("in_use", 1);
  expectFault(request("any"), DeviceFault::kInUse, "Failed to set USB interface");
}

TEST_F(OpenNi2DeviceTest, NotPermitted) {
  control("no_permission", 1);
  expectFault(request("any"), DeviceFault::kNoPermission, "denied");
}

TEST_F(OpenNi2DeviceTest, WithoutColor) {
  control("color", 0);
  expectFault(request("any"), DeviceFault::kNoColor, "has no color stream");
}

TEST_F(OpenNi2DeviceTest, WithoutRegistration) {
  control("registration", 0);
  expectFault(request("any"), DeviceFault::kNoRegistration, "cannot register depth to color");
}

TEST_F(OpenNi2DeviceTest, ModeThatIsNotOffered) {
  DeviceRequest other = request("any");
  other.width = 320;
  other.height = 240;
  expectFault(other, DeviceFault::kNoMode, "640x480 at 30 Hz, RGB888");
}

TEST_F(OpenNi2DeviceTest, SettingsHoldOnceTheFirstImageCame) {
  const auto device = OpenNi2Device::open(request("any"));
  CameraSettings wanted;
  wanted.auto_exposure = false;
  wanted.auto_white_balance = false;
  wanted.exposure = 17;
  wanted.gain = 60;
  device->applySettings(wanted);
  startBoth(*device);
  EXPECT_NE(device->settings(), wanted) << "the camera forgets what is set before it streams";
  receive(*device, 1);
  device->applySettings(wanted);
  EXPECT_EQ(device->settings(), wanted);
  EXPECT_EQ(disobeyed(wanted, device->settings()), "");
}

TEST_F(OpenNi2DeviceTest, DeafCameraTellsItsTrueSettings) {
  control("deaf", 1);
  const auto device = OpenNi2Device::open(request("any"));
  startBoth(*device);
  receive(*device, 1);
  CameraSettings wanted;
  wanted.auto_exposure = false;
  device->applySettings(wanted);
  EXPECT_EQ(disobeyed(wanted, device->settings()), "auto exposure stays on instead of off");
}

TEST_F(OpenNi2DeviceTest, UnpluggedIsNoticedAndReopenedWorks) {
  {
    const auto device = OpenNi2Device::open(request("any"));
    startBoth(*device);
    receive(*device, 1);
    ASSERT_TRUE(device->isConnected());
    control("present", 0);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (device->isConnected() && std::chrono::steady_clock::now() < end) {
      device->read(milliseconds(20), [](const ImageView&) {});
    }
    EXPECT_FALSE(device->isConnected());
  }
  expectFault(request("any"), DeviceFault::kNoDevice, "No OpenNI2 camera");
  control("present", 1);
  const auto device = OpenNi2Device::open(request("any"));
  startBoth(*device);
  EXPECT_GE(receive(*device, 1).at(StreamKind::kDepth).size(), 1U);
}

TEST_F(OpenNi2DeviceTest, StreamsStopAndStartAgain) {
  const auto device = OpenNi2Device::open(request("any"));
  startBoth(*device);
  receive(*device, 1);
  device->stop(StreamKind::kDepth);
  int depth = 0;
  int color = 0;
  while (color < 10) {
    device->read(milliseconds(200), [&](const ImageView& view) {
      (view.kind == StreamKind::kColor ? color : depth) += 1;
    });
  }
  EXPECT_LE(depth, 1);  // one may have been under way
  device->start(StreamKind::kDepth);
  EXPECT_GE(synchronousPairs(receive(*device, 5)), 1);
}

TEST_F(OpenNi2DeviceTest, WithoutSynchronizationTheStreamsAreOutOfStep) {
  DeviceRequest independent = request("any");
  independent.synchronize = false;
  const auto device = OpenNi2Device::open(independent);
  startBoth(*device);
  EXPECT_EQ(synchronousPairs(receive(*device, 5)), 0);
}

TEST_F(OpenNi2DeviceTest, SilentStreamsTimeOut) {
  control("color_stalls", 1);
  control("depth_stalls", 1);
  const auto device = OpenNi2Device::open(request("any"));
  startBoth(*device);
  EXPECT_FALSE(device->read(milliseconds(200), [](const ImageView&) { FAIL(); }));
}

TEST_F(OpenNi2DeviceTest, LostImagesShowInTheFrameNumbers) {
  control("drop_every", 4);
  const auto device = OpenNi2Device::open(request("any"));
  startBoth(*device);
  const auto received = receive(*device, 12);
  int dropped = 0;
  const auto& color = received.at(StreamKind::kColor);
  for (std::size_t i = 1; i < color.size(); ++i) {
    dropped += color[i].index - color[i - 1].index - 1;
  }
  EXPECT_GE(dropped, static_cast<int>(color.size()) / 4 - 1);
}

}  // namespace
}  // namespace mivo
