// SPDX-License-Identifier: BSD-3-Clause
// The device without hardware that comes with libOpenNI2. In a process of its own, because the
// library stays loaded once the Dummy has streamed.

#include "openni2_device_fixture.h"

namespace mivo {
namespace {

using OpenNi2DummyTest = OpenNi2DeviceTest;

TEST_F(OpenNi2DummyTest, IsRefusedWhenItCannotDoWhatIsAsked) {
  expectFault(request("Dummy"), DeviceFault::kNoMode, "320x240");
  DeviceRequest small = request("Dummy");
  small.width = 320;
  small.height = 240;
  expectFault(small, DeviceFault::kNoRegistration, "cannot register");
}

TEST_F(OpenNi2DummyTest, StreamsAndIsClosedAgainAndAgain) {
  DeviceRequest small = request("Dummy");
  small.width = 320;
  small.height = 240;
  small.registration = false;
  for (int i = 0; i < 5; ++i) {
    const auto device = OpenNi2Device::open(small);
    EXPECT_FALSE(device->description().has_camera_settings);
    EXPECT_FALSE(device->description().notes.empty());
    EXPECT_EQ(device->description().color_field_of_view, 0.0);
    startBoth(*device);
    const auto received = receive(*device, 2);
    EXPECT_EQ(received.at(StreamKind::kColor).front().image.size(), cv::Size(320, 240));
  }
  // After closing it, the library can open another device.
  const auto device = OpenNi2Device::open(request("any"));
  startBoth(*device);
  EXPECT_GE(receive(*device, 1).at(StreamKind::kColor).size(), 1U);
}

}  // namespace
}  // namespace mivo
