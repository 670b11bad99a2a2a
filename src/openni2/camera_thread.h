// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "openni2/camera_session.h"

namespace mivo {

/// Runs a CameraSession in a thread of its own. Member functions do not block: requests are queued
/// for the thread, the status is a copy.
class CameraThread {
 public:
  CameraThread(DeviceRequest request, SessionTimes times, DeviceFactory factory,
               CameraSession::HostClock host_clock, CameraListener& listener);
  /// Stops the streams, closes the device and joins: may wait for USB.
  ~CameraThread();
  CameraThread(const CameraThread&) = delete;
  CameraThread& operator=(const CameraThread&) = delete;

  void setDemand(const StreamDemand& demand);
  void setSettings(const CameraSettings& settings);
  CameraStatus status() const;

  /// Processor time that the thread has used so far, s.
  double processorTime() const { return processor_time_.load(); }

 private:
  void run();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::optional<StreamDemand> new_demand_;
  std::optional<CameraSettings> new_settings_;
  CameraStatus status_;
  std::atomic<double> processor_time_{0.0};
  CameraSession session_;  // used by the thread only
  std::thread thread_;     // last: starts when all else exists
};

}  // namespace mivo
