// SPDX-License-Identifier: BSD-3-Clause
// A recording of the virtual camera, played by the same class, gives the same images.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "openni2/openni2_device.h"
#include "openni2/recorder.h"
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
};

TEST_F(RecordingTest, PlaysBackEqualAndThenFallsSilent) {
  const std::string path = folder_ + "/recording.oni";
  recordVirtualXtion(path, 2 * (kFrames + 12), [this] { play(); });
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
  // The player drops images that are not read in time, and comparing takes longer than a frame
  // period.
  EXPECT_GE(std::count(seen[StreamKind::kColor].begin(), seen[StreamKind::kColor].end(), true), 3);
  EXPECT_GE(std::count(seen[StreamKind::kDepth].begin(), seen[StreamKind::kDepth].end(), true), 3);
  EXPECT_TRUE(seen[StreamKind::kColor][kFrames - 1]);
}

}  // namespace
}  // namespace mivo
