// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "control_file.h"
#include "served_sequence.h"
#include "virtual_stream.h"

namespace virtual_xtion {

/// Latest control, shared by driver and devices.
class SharedControl {
 public:
  Control get() const;
  void set(const Control& control);

 private:
  mutable std::mutex mutex_;
  Control control_;
};

/// The camera: a sensor thread takes an image every thirtieth of a second of the host's clock and
/// hands it to the streams that run, with the faults that the control asks for.
class VirtualDevice : public oni::driver::DeviceBase {
 public:
  VirtualDevice(const SharedControl& control, int number);
  ~VirtualDevice() override;

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

  /// The camera forgets it when a stream starts or stops.
  void resetSynchronization() { synchronized_ = false; }

 private:
  struct Delivery {
    OniSensorType sensor;
    cv::Mat image;
    std::uint64_t stamp;
    int index;
  };

  void run();
  void take(std::int64_t tick, const Control& control);
  std::size_t nextFrame(const Control& control) const;
  bool isLost(std::int64_t tick, const Control& control) const;
  cv::Mat seen(OniSensorType sensor, VirtualStream& stream, const ServedSequence::Images& images);
  std::uint64_t deviceTime(std::int64_t host, const Control& control) const;
  void deliverDue(std::int64_t now);
  void logTruth(std::uint64_t stamp, std::int64_t host, std::size_t frame, const Control& control);

  const SharedControl& control_;
  const int number_;
  ServedSequence sequence_;
  std::int64_t power_on_;  ///< host time, ns, of device time 0
  std::vector<OniVideoMode> color_modes_;
  std::vector<OniVideoMode> depth_modes_;
  std::vector<OniSensorInfo> sensors_;
  std::atomic<bool> registered_{false};
  std::atomic<bool> synchronized_{false};

  std::mutex mutex_;  ///< guards streams_ and stop_
  std::condition_variable wake_;
  std::map<OniSensorType, VirtualStream*> streams_;
  bool stop_ = false;

  // The sensor thread's own.
  std::multimap<std::int64_t, Delivery> under_way_;
  std::mt19937 random_{1};
  std::ofstream truth_;
  std::optional<std::size_t> last_frame_;  ///< image of the sequence that was taken last
  std::thread thread_;
};

}  // namespace virtual_xtion
