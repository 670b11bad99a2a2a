// SPDX-License-Identifier: BSD-3-Clause
// Stamps of the whole chain: virtual camera, libOpenNI2, thread, clock filter; against the times at
// which the virtual camera took its images.

#include <gtest/gtest.h>

#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "mivo/openni2/camera_thread.h"
#include "mivo/openni2/openni2_device.h"
#include "virtual_xtion_fixture.h"

namespace mivo {
namespace {

class StampListener : public CameraListener {
 public:
  struct Stamp {
    std::uint64_t device;
    std::int64_t host;
  };

  void onImage(const ImageView& image, std::int64_t stamp) override {
    if (image.kind == StreamKind::kColor) {
      const std::lock_guard<std::mutex> lock(mutex_);
      stamps_.push_back({image.device_stamp, stamp});
      changed_.notify_all();
    }
  }
  void onMessage(Severity /*severity*/, const std::string& /*line*/) override {}
  void onDevice(const DeviceDescription& /*device*/) override {}
  void onSettings(const CameraSettings& /*settings*/) override {}

  bool waitFor(std::size_t count, std::chrono::seconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return stamps_.size() >= count; });
  }

  std::vector<Stamp> stamps_;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
};

class StampTest : public VirtualXtionTest {};

TEST_F(StampTest, AreTheTimesOfCaptureThoughTheClockIsOffAndArrivalJitters) {
  control("clock_ppm", 200);
  control("jitter", 0.003);
  control("truth", truthPath());
  StampListener listener;
  constexpr std::size_t kImages = 200;
  {
    CameraThread thread(DeviceRequest{}, SessionTimes{}, OpenNi2Device::open, hostNow, listener);
    thread.setDemand({true, true});
    ASSERT_TRUE(listener.waitFor(kImages, std::chrono::seconds(30)));
  }
  std::map<std::uint64_t, std::int64_t> truth;
  std::ifstream file(truthPath());
  std::uint64_t device = 0;
  std::int64_t host = 0;
  int frame = 0;
  while (file >> device >> host >> frame) {
    truth[device] = host;
  }
  std::int64_t previous = 0;
  double worst = 0.0;
  for (const StampListener::Stamp& stamp : listener.stamps_) {
    ASSERT_EQ(truth.count(stamp.device), 1U);
    EXPECT_GT(stamp.host, previous);
    previous = stamp.host;
    worst = std::max(worst, 1e-6 * std::abs(static_cast<double>(stamp.host - truth[stamp.device])));
  }
  EXPECT_LT(worst, 2.0) << "ms";
  RecordProperty("worst_ms", std::to_string(worst));
}

}  // namespace
}  // namespace mivo
