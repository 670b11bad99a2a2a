// SPDX-License-Identifier: BSD-3-Clause
// A camera without hardware: a driver library of OpenNI2 that serves a sequence folder as an Xtion
// Pro Live would, through the real libOpenNI2. control_file.h says what it can be told to do.

#include <Driver/OniDriverAPI.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "control_file.h"
#include "virtual_device.h"

namespace virtual_xtion {
namespace {

constexpr std::chrono::milliseconds kPoll(10);
const std::string kUri = "virtual_xtion://";

OniDeviceInfo infoOf(int number) {
  OniDeviceInfo info{};
  std::snprintf(info.uri, sizeof(info.uri), "%s%d", kUri.c_str(), number);
  std::snprintf(info.vendor, sizeof(info.vendor), "mivo");
  std::snprintf(info.name, sizeof(info.name), "Virtual Xtion");
  info.usbVendorId = 0x1d27;
  info.usbProductId = 0x0601;
  return info;
}

}  // namespace

class VirtualDriver : public oni::driver::DriverBase {
 public:
  explicit VirtualDriver(OniDriverServices* services)
      : DriverBase(services), path_(controlPath()) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed,
                       void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    if (path_.empty()) {
      return ONI_STATUS_OK;  // not asked for: no camera
    }
    update();
    thread_ = std::thread(&VirtualDriver::poll, this);
    return ONI_STATUS_OK;
  }

  void shutdown() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) {
      thread_.join();
    }
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override {
    const Control control = control_.get();
    if (control.in_use) {
      getServices().errorLoggerAppend("Failed to set USB interface!");
      return nullptr;
    }
    if (control.no_permission) {
      getServices().errorLoggerAppend("USB access is denied!");
      return nullptr;
    }
    try {
      return new VirtualDevice(control_, std::stoi(std::string(uri).substr(kUri.size())));
    } catch (const std::exception& error) {
      getServices().errorLoggerAppend("%s", error.what());
      return nullptr;
    }
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void* enableFrameSync(oni::driver::StreamBase** /*streams*/, int /*count*/) override {
    // It has just freed, or is about to free, what images that are under way are handed to.
    std::fputs("virtual_xtion: the SDK's own synchronization is not safe while images come\n",
               stderr);
    std::abort();
  }

 private:
  // Reads the control file and plugs cameras in and out. A file that cannot be understood is said
  // on stderr, where a test's log shows it, and changes nothing.
  void update() {
    try {
      control_.set(readControl(path_));
    } catch (const std::exception& error) {
      if (complaint_ != error.what()) {
        complaint_ = error.what();
        std::fprintf(stderr, "virtual_xtion: %s\n", error.what());
      }
      return;
    }
    const Control control = control_.get();
    const int wanted = control.present ? control.devices : 0;
    for (; plugged_ < wanted; ++plugged_) {
      const OniDeviceInfo info = infoOf(plugged_);
      deviceConnected(&info);
    }
    for (; plugged_ > wanted; --plugged_) {
      const OniDeviceInfo info = infoOf(plugged_ - 1);
      deviceDisconnected(&info);
    }
  }

  void poll() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!wake_.wait_for(lock, kPoll, [&] { return stop_; })) {
      update();
    }
  }

  const std::string path_;
  SharedControl control_;
  int plugged_ = 0;
  std::string complaint_;  ///< last one on stderr
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace virtual_xtion

// The SDK's macro below needs these two from a library that is not packaged.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
ONI_EXPORT_DRIVER(virtual_xtion::VirtualDriver)
