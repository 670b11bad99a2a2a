// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "openni2/camera_device.h"
#include "openni2/device_error.h"

namespace mivo {

/// Controls a FakeCamera and records the calls; outlives the devices that are opened.
struct FakeCameraWorld {
  std::optional<DeviceFault> open_fault;  ///< opening fails with it
  std::string read_error;                 ///< reading throws it, which is no DeviceError
  bool connected = true;
  std::array<bool, kStreamKinds> silent{};
  bool is_recording = false;
  bool has_settings = true;
  bool deaf = false;  ///< ignores settings
  int skip = 1;       ///< 2: every second image is lost

  int open_attempts = 0;
  int open_devices = 0;
  std::array<bool, kStreamKinds> running{};
  std::vector<std::string> calls;
  CameraSettings settings;
  int images_before_settings = -1;  ///< images that had been read when settings came first
  int images = 0;
  std::uint64_t time = 1000000;  ///< microseconds of the device; grows with each read
};

/// A device that delivers an image of each running stream for every thirtieth of a second.
class FakeCamera : public CameraDevice {
 public:
  explicit FakeCamera(FakeCameraWorld& world) : world_(world) {
    ++world_.open_devices;
    description_.uri = "fake://0";
    description_.name = "Fake Camera";
    description_.is_recording = world.is_recording;
    description_.has_camera_settings = world.has_settings;
  }
  ~FakeCamera() override {
    --world_.open_devices;
    world_.running = {};
  }

  const DeviceDescription& description() const override { return description_; }
  void start(StreamKind kind) override { set(kind, true, "start "); }
  void stop(StreamKind kind) override { set(kind, false, "stop "); }
  bool isConnected() const override { return world_.connected; }

  bool read(std::chrono::milliseconds /*timeout*/,
            const std::function<void(const ImageView&)>& callback) override {
    if (!world_.read_error.empty()) {
      throw std::runtime_error(world_.read_error);
    }
    for (int tried = 0; tried < kStreamKinds; ++tried) {
      const auto k = static_cast<std::size_t>(next_);
      next_ = 1 - next_;
      if (k == 0) {
        world_.time += 33333;
        ++index_;
      }
      if (!world_.running[k] || world_.silent[k] || index_ % world_.skip != 0) {
        continue;
      }
      ImageView image;
      image.kind = static_cast<StreamKind>(k);
      image.device_stamp = world_.time;
      image.index = index_;
      ++world_.images;
      callback(image);
      return true;
    }
    return false;
  }

  void applySettings(const CameraSettings& settings) override {
    if (world_.images_before_settings < 0) {
      world_.images_before_settings = world_.images;
    }
    if (!world_.deaf) {
      world_.settings = settings;
    }
  }
  CameraSettings settings() const override { return world_.settings; }

 private:
  void set(StreamKind kind, bool on, const char* verb) {
    world_.running[static_cast<std::size_t>(kind)] = on;
    world_.calls.push_back(std::string(verb) + toString(kind));
  }

  FakeCameraWorld& world_;
  DeviceDescription description_;
  int next_ = 0;
  int index_ = 0;
};

inline DeviceFactory fakeFactory(FakeCameraWorld& world) {
  return [&world](const DeviceRequest&) -> std::unique_ptr<CameraDevice> {
    ++world.open_attempts;
    if (world.open_fault) {
      throw DeviceError(*world.open_fault, "The fake camera does not open");
    }
    return std::make_unique<FakeCamera>(world);
  };
}

}  // namespace mivo
