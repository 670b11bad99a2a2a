// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "openni2/camera_device.h"
#include "openni2/camera_listener.h"
#include "openni2/clock_filter.h"
#include "openni2/device_error.h"
#include "openni2/rate_monitor.h"

namespace mivo {

enum class CameraState {
  kConnecting,  ///< about to open the device for the first time
  kWaiting,     ///< no device: tries again after a pause that doubles each time
  kIdle,        ///< device open, no subscribers
  kStreaming,   ///< delivering images
  kEnded        ///< the recording has been played
};

const char* toString(CameraState state);

struct StreamStatistics {
  double rate = 0.0;  ///< Hz, over the last seconds; 0: not known yet
  std::int64_t frames = 0;
  std::int64_t dropped = 0;
};

/// Status of the camera.
struct CameraStatus {
  CameraState state = CameraState::kConnecting;
  std::optional<DeviceFault> fault;  ///< reason of waiting
  std::string message;               ///< one line for the user
  std::string listener_fault;        ///< what the listener threw last; empty: nothing
  bool slow = false;                 ///< the rate of a stream is markedly too low
  int failures = 0;                  ///< attempts in a row that failed
  int reconnections = 0;             ///< devices opened after the first
  double clock_skew = 0.0;           ///< device clock relative to the host's, minus 1
  std::array<StreamStatistics, kStreamKinds> streams;
  DeviceDescription device;  ///< of the last device that was open
  CameraSettings settings;   ///< as read back from the camera
};

struct StreamDemand {
  bool color = false;
  bool depth = false;
  bool any() const { return color || depth; }
  bool wants(StreamKind kind) const { return kind == StreamKind::kColor ? color : depth; }
};

struct SessionTimes {
  std::chrono::milliseconds first_pause{500};     ///< after the first failure
  std::chrono::milliseconds longest_pause{8000};  ///< the pause doubles up to this
  std::chrono::milliseconds first_image{5000};    ///< a stream that starts must deliver within this
  std::chrono::milliseconds next_image{2000};     ///< a running stream must deliver within this
  std::chrono::milliseconds read{50};             ///< longest wait in one step
  std::chrono::milliseconds check{500};           ///< interval of checks of an idle device
  /// Images discarded after the start of a stream, while exposure settles, settings take effect,
  /// and the clock offset is estimated. Recordings lose none.
  int warm_up_images = 10;
  /// Maximum number of further ones while the estimate of the clock offset is still decreasing, on
  /// a busy machine.
  int most_unsettled_images = 120;
};

/// Session of a camera: opens it, runs the requested streams, stamps images, detects loss and
/// retries with back-off. A state machine without a thread and clock of its own.
class CameraSession {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// Host time for stamps, ns since the epoch.
  using HostClock = std::function<std::int64_t()>;

  CameraSession(DeviceRequest request, SessionTimes times, DeviceFactory factory,
                HostClock host_clock, CameraListener& listener);

  void setDemand(const StreamDemand& demand);
  void setSettings(const CameraSettings& settings);

  /// Performs one step, reading at most one image. Returns the time until the next step (zero: call
  /// again at once).
  std::chrono::milliseconds step(Time now);

  CameraStatus status() const;

 private:
  struct Stream {
    bool running = false;
    bool delivered = false;  ///< since it was started
    Time last_image;         ///< or the start
    int warm_up = 0;         ///< images still to be held back
    int unsettled = 0;       ///< and so many more until the clock filter has settled
    RateMonitor monitor;
  };

  std::chrono::milliseconds advance(Time now);
  std::chrono::milliseconds connect(Time now);
  void opened();
  void failed(const DeviceError& error, Time now);
  void recordingEnded();
  void releaseDevice();
  void startAndStop(Time now);
  void stepDevice(Time now);
  void receive(const ImageView& image, Time now);
  bool isWarmingUp(Stream& stream) const;
  void checkSilence(Time now);
  void checkRate();
  void applySettings();
  Stream& stream(StreamKind kind) { return streams_[static_cast<std::size_t>(kind)]; }

  DeviceRequest request_;
  SessionTimes times_;
  DeviceFactory factory_;
  HostClock host_clock_;
  GuardedListener listener_;

  StreamDemand demand_;
  CameraSettings wanted_settings_;
  bool settings_pending_ = true;
  std::unique_ptr<CameraDevice> device_;
  std::array<Stream, kStreamKinds> streams_;
  ClockFilter clock_filter_;
  CameraStatus status_;
  std::chrono::milliseconds pause_{0};
  Time next_attempt_;
  bool was_open_ = false;
  bool device_delivered_ = false;  ///< an image since it was opened
};

}  // namespace mivo
