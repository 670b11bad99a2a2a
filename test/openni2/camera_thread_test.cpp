// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/camera_thread.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>

#include "fake_camera.h"

namespace mivo {
namespace {

using std::chrono::seconds;

class CountingListener : public CameraListener {
 public:
  void onImage(const ImageView& /*image*/, std::int64_t /*stamp*/) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++images_;
    thread_ = std::this_thread::get_id();
    changed_.notify_all();
  }
  void onMessage(Severity /*severity*/, const std::string& /*line*/) override {}
  void onDevice(const DeviceDescription& /*device*/) override {}
  void onSettings(const CameraSettings& settings) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    settings_ = settings;
    changed_.notify_all();
  }

  bool waitFor(const std::function<bool(const CountingListener&)>& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, seconds(10), [&] { return condition(*this); });
  }

  int images_ = 0;
  std::optional<CameraSettings> settings_;
  std::thread::id thread_;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
};

std::int64_t hostNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

TEST(CameraThreadTest, ImagesComeInAThreadOfTheirOwnOnceWanted) {
  FakeCameraWorld world;
  CountingListener listener;
  CameraThread thread(DeviceRequest{}, SessionTimes{}, fakeFactory(world), hostNow, listener);
  thread.setDemand({true, true});
  ASSERT_TRUE(listener.waitFor([](const auto& l) { return l.images_ > 100; }));
  EXPECT_NE(listener.thread_, std::this_thread::get_id());
  CameraSettings settings;
  settings.gain = 50;
  thread.setSettings(settings);
  EXPECT_TRUE(listener.waitFor(
      [&](const auto& l) { return l.settings_.has_value() && l.settings_->gain == 50; }));
  EXPECT_EQ(thread.status().state, CameraState::kStreaming);
  EXPECT_GT(thread.processorTime(), 0.0);
}

TEST(CameraThreadTest, NoCallWaitsForAnOpenThatHangs) {
  std::promise<void> release;
  std::shared_future<void> released = release.get_future().share();
  std::promise<void> entered;
  FakeCameraWorld world;
  CountingListener listener;
  const DeviceFactory slow = [&](const DeviceRequest& request) {
    entered.set_value();
    released.wait();
    return fakeFactory(world)(request);
  };
  {
    CameraThread thread(DeviceRequest{}, SessionTimes{}, slow, hostNow, listener);
    entered.get_future().wait();
    // All of these return though the thread is inside of the device: otherwise the test hangs here.
    thread.setDemand({true, true});
    thread.setSettings({});
    EXPECT_EQ(thread.status().state, CameraState::kConnecting);
    release.set_value();
    EXPECT_TRUE(listener.waitFor([](const auto& l) { return l.images_ > 0; }));
  }
  EXPECT_EQ(world.open_devices, 0);
}

}  // namespace
}  // namespace mivo
