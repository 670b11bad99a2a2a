// SPDX-License-Identifier: BSD-3-Clause
// Stamps of the whole chain: virtual camera, libOpenNI2, thread, session, clock filter; against the
// times at which the virtual camera took its images.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <random>
#include <utility>

#include "openni2/camera_thread.h"
#include "openni2/openni2_device.h"
#include "virtual_xtion_fixture.h"

namespace mivo {
namespace {

constexpr double kMeanDelay = 0.003;     // s
constexpr double kLongestHoldUp = 0.02;  // s, added by a busy machine
constexpr double kBusyPart = 0.5;        // of the images
constexpr double kNanosecondsPerSecond = 1e9;

/// The virtual camera's log of its images: host time by device stamp. Each line is written before
/// its image is delivered.
class Truth {
 public:
  explicit Truth(const std::string& path) : path_(path) {}

  std::int64_t taken(std::uint64_t stamp) {
    if (!file_.is_open()) {
      file_.open(path_);
    }
    file_.clear();  // resets the end-of-file state
    std::uint64_t device = 0;
    std::int64_t host = 0;
    int frame = 0;
    while (times_.count(stamp) == 0 && file_ >> device >> host >> frame) {
      times_[device] = host;
    }
    return times_.at(stamp);
  }

 private:
  std::string path_;
  std::ifstream file_;
  std::map<std::uint64_t, std::int64_t> times_;
};

/// Arrival times of images: exposure plus a random delay, which, unlike the machine's own delays,
/// does not depend on its load.
class Arrivals {
 public:
  explicit Arrivals(const std::string& truth) : truth_(truth) {}

  void add(std::uint64_t stamp) {
    double late = kMeanDelay * delay_(random_);
    late += uniform_(random_) < kBusyPart ? kLongestHoldUp * uniform_(random_) : 0.0;
    arrival_ = truth_.taken(stamp) + std::llround(late * kNanosecondsPerSecond);
  }
  std::int64_t last() const { return arrival_; }

 private:
  Truth truth_;
  std::mt19937 random_{7};
  std::exponential_distribution<double> delay_{1.0};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
  std::int64_t arrival_ = 0;
};

/// A camera that reports the arrival of each image before delivering it.
class TimedCamera : public CameraDevice {
 public:
  TimedCamera(std::unique_ptr<CameraDevice> device, Arrivals& arrivals)
      : device_(std::move(device)), arrivals_(arrivals) {}

  const DeviceDescription& description() const override { return device_->description(); }
  void start(StreamKind kind) override { device_->start(kind); }
  void stop(StreamKind kind) override { device_->stop(kind); }
  bool isConnected() const override { return device_->isConnected(); }
  bool read(std::chrono::milliseconds timeout,
            const std::function<void(const ImageView&)>& callback) override {
    return device_->read(timeout, [&](const ImageView& image) {
      arrivals_.add(image.device_stamp);
      callback(image);
    });
  }
  void applySettings(const CameraSettings& settings) override { device_->applySettings(settings); }
  CameraSettings settings() const override { return device_->settings(); }

 private:
  std::unique_ptr<CameraDevice> device_;
  Arrivals& arrivals_;
};

class StampListener : public CameraListener {
 public:
  struct Stamp {
    std::uint64_t device;
    std::int64_t host;
  };

  void onImage(const ImageView& image, std::int64_t stamp) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    stamps_[image.kind].push_back({image.device_stamp, stamp});
    changed_.notify_all();
  }
  void onMessage(Severity /*severity*/, const std::string& /*line*/) override {}
  void onDevice(const DeviceDescription& /*device*/) override {}
  void onSettings(const CameraSettings& /*settings*/) override {}

  bool waitFor(std::size_t count, std::chrono::seconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] {
      return stamps_[StreamKind::kColor].size() >= count &&
             stamps_[StreamKind::kDepth].size() >= count;
    });
  }

  std::map<StreamKind, std::vector<Stamp>> stamps_;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
};

class StampTest : public VirtualXtionTest {};

TEST_F(StampTest, AreTheTimesOfCaptureThoughTheClockIsOffAndTheMachineBusy) {
  control("clock_ppm", 200);
  control("truth", truthPath());
  StampListener listener;
  Arrivals arrivals(truthPath());
  constexpr std::size_t kImages = 200;
  {
    const auto open = [&](const DeviceRequest& request) {
      return std::make_unique<TimedCamera>(OpenNi2Device::open(request), arrivals);
    };
    CameraThread thread(
        DeviceRequest{}, SessionTimes{}, open, [&] { return arrivals.last(); }, listener);
    thread.setDemand({true, true});
    ASSERT_TRUE(listener.waitFor(kImages, std::chrono::seconds(60)));
  }
  Truth truth(truthPath());
  double worst = 0.0;
  for (const auto& [kind, stamps] : listener.stamps_) {
    std::int64_t previous = 0;
    for (const StampListener::Stamp& stamp : stamps) {
      EXPECT_GT(stamp.host, previous) << toString(kind);
      previous = stamp.host;
      const auto error = static_cast<double>(stamp.host - truth.taken(stamp.device));
      worst = std::max(worst, 1e-6 * std::abs(error));
    }
  }
  EXPECT_LT(worst, 2.0) << "ms";
  EXPECT_GT(worst, 0.0) << "nothing was compared";
  std::cout << "== worst error " << worst << " ms\n";
}

}  // namespace
}  // namespace mivo
