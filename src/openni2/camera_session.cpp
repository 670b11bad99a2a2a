// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/camera_session.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace mivo {
namespace {

constexpr std::array<StreamKind, kStreamKinds> kKinds{StreamKind::kColor, StreamKind::kDepth};

// A stream counts as slow below the first fraction of the rate it should have, and as recovered
// above the second. The gap between them tolerates single dropped images.
constexpr double kSlowFraction = 0.8;
constexpr double kFastFraction = 0.9;

std::string seconds(std::chrono::milliseconds time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", static_cast<double>(time.count()) / 1000.0);
  return text.data();
}

}  // namespace

const char* toString(CameraState state) {
  switch (state) {
    case CameraState::kConnecting:
      return "connecting";
    case CameraState::kWaiting:
      return "waiting for the camera";
    case CameraState::kIdle:
      return "idle";
    case CameraState::kStreaming:
      return "streaming";
    case CameraState::kEnded:
      return "recording ended";
  }
  return "unknown";
}

CameraSession::CameraSession(DeviceRequest request, SessionTimes times, DeviceFactory factory,
                             HostClock host_clock, CameraListener& listener)
    : request_(std::move(request)),
      times_(times),
      factory_(std::move(factory)),
      host_clock_(std::move(host_clock)),
      listener_(listener) {}

void CameraSession::setDemand(const StreamDemand& demand) {
  demand_ = demand;
  if (status_.state == CameraState::kEnded && !demand_.any()) {
    status_.state = CameraState::kConnecting;  // the next subscriber sees it from the start
    next_attempt_ = Time();
  }
}

void CameraSession::setSettings(const CameraSettings& settings) {
  wanted_settings_ = settings;
  settings_pending_ = true;
}

std::chrono::milliseconds CameraSession::step(Time now) {
  if (status_.state == CameraState::kEnded) {
    return times_.check;
  }
  try {
    return advance(now);
  } catch (const DeviceError& error) {
    failed(error, now);
  } catch (const std::exception& error) {  // no exception may end the process
    failed(DeviceError(DeviceFault::kUnexpected, error.what()), now);
  }
  return pause_;
}

std::chrono::milliseconds CameraSession::advance(Time now) {
  if (!device_) {
    return connect(now);
  }
  stepDevice(now);
  return status_.state == CameraState::kStreaming ? std::chrono::milliseconds(0) : times_.check;
}

std::chrono::milliseconds CameraSession::connect(Time now) {
  if (now < next_attempt_) {
    return std::chrono::duration_cast<std::chrono::milliseconds>(next_attempt_ - now) +
           std::chrono::milliseconds(1);
  }
  device_ = factory_(request_);
  opened();
  return std::chrono::milliseconds(0);
}

void CameraSession::opened() {
  status_.device = device_->description();
  status_.state = CameraState::kIdle;
  status_.fault.reset();
  status_.message = status_.device.name + " (" + status_.device.uri + ") is open";
  if (was_open_) {
    ++status_.reconnections;
  }
  was_open_ = true;
  device_delivered_ = false;
  settings_pending_ = true;
  clock_filter_.reset();
  listener_.onMessage(Severity::kInfo, status_.message);
  for (const std::string& note : status_.device.notes) {
    listener_.onMessage(Severity::kWarning, note);
  }
  listener_.onDevice(status_.device);
}

void CameraSession::failed(const DeviceError& error, Time now) {
  releaseDevice();
  ++status_.failures;
  pause_ = status_.failures == 1 ? times_.first_pause : std::min(2 * pause_, times_.longest_pause);
  next_attempt_ = now + pause_;
  const bool is_news = status_.state != CameraState::kWaiting || status_.message != error.what();
  status_.state = CameraState::kWaiting;
  status_.fault = error.fault();
  status_.message = error.what();
  if (is_news) {
    listener_.onMessage(Severity::kError, status_.message + ". Retrying at least every " +
                                              seconds(times_.longest_pause));
  }
}

void CameraSession::recordingEnded() {
  releaseDevice();
  status_.state = CameraState::kEnded;
  status_.message =
      "The recording " + request_.address + " has ended; set repeat to true to play it in a loop";
  listener_.onMessage(Severity::kInfo, status_.message);
}

void CameraSession::releaseDevice() {
  device_.reset();
  for (Stream& stream : streams_) {
    stream.running = false;
  }
  status_.slow = false;
}

void CameraSession::startAndStop(Time now) {
  for (StreamKind kind : kKinds) {
    Stream& stream = this->stream(kind);
    if (demand_.wants(kind) && !stream.running) {
      device_->start(kind);
      stream.running = true;
      stream.delivered = false;
      stream.last_image = now;
      stream.warm_up = status_.device.is_recording ? 0 : times_.warm_up_images;
      stream.unsettled = status_.device.is_recording ? 0 : times_.most_unsettled_images;
      stream.monitor.restart();
      settings_pending_ = settings_pending_ || kind == StreamKind::kColor;
    } else if (!demand_.wants(kind) && stream.running) {
      device_->stop(kind);
      stream.running = false;
      stream.monitor.restart();
    }
  }
  status_.state = demand_.any() ? CameraState::kStreaming : CameraState::kIdle;
}

void CameraSession::stepDevice(Time now) {
  if (!device_->isConnected()) {
    throw DeviceError(DeviceFault::kLost, status_.device.name + " was unplugged");
  }
  startAndStop(now);
  if (!demand_.any()) {
    status_.failures = 0;
    status_.slow = false;
    return;
  }
  device_->read(times_.read, [&](const ImageView& image) { receive(image, now); });
  if (settings_pending_ && demand_.color && stream(StreamKind::kColor).delivered) {
    applySettings();
  }
  checkSilence(now);
}

void CameraSession::receive(const ImageView& image, Time now) {
  const std::int64_t arrival = host_clock_();
  Stream& stream = this->stream(image.kind);
  if (!stream.running) {
    return;  // arrived after its stream was stopped
  }
  stream.last_image = now;
  stream.delivered = true;
  device_delivered_ = true;
  status_.failures = 0;
  stream.monitor.add(image.device_stamp, image.index);
  clock_filter_.observe(image.device_stamp, arrival);
  if (isWarmingUp(stream)) {
    return;
  }
  listener_.onImage(image, clock_filter_.hostTime(image.kind, image.device_stamp));
  checkRate();
}

bool CameraSession::isWarmingUp(Stream& stream) const {
  if (stream.warm_up > 0) {
    --stream.warm_up;
    return true;
  }
  if (stream.unsettled > 0 && !clock_filter_.isSettled()) {
    --stream.unsettled;
    return true;
  }
  stream.unsettled = 0;
  return false;
}

void CameraSession::checkSilence(Time now) {
  bool all_silent = true;
  std::optional<StreamKind> silent;
  for (StreamKind kind : kKinds) {
    const Stream& stream = this->stream(kind);
    if (!stream.running) {
      continue;
    }
    const auto limit = stream.delivered ? times_.next_image : times_.first_image;
    if (now - stream.last_image > limit) {
      silent = kind;
    } else {
      all_silent = false;
    }
  }
  if (!silent) {
    return;
  }
  if (!status_.device.is_recording) {
    const bool delivered = stream(*silent).delivered;
    throw DeviceError(delivered ? DeviceFault::kLost : DeviceFault::kUsb,
                      status_.device.name + " delivers no " + toString(*silent) +
                          (delivered ? " any more" : ", though the stream was started"));
  }
  if (all_silent && !device_delivered_) {
    throw DeviceError(DeviceFault::kBadRecording,
                      "The recording " + request_.address + " delivers no image");
  }
  if (all_silent) {
    recordingEnded();
  }
}

void CameraSession::checkRate() {
  if (status_.device.is_recording) {
    return;
  }
  for (StreamKind kind : kKinds) {
    const double rate = stream(kind).monitor.rate();
    if (rate <= 0.0) {
      continue;
    }
    std::array<char, 256> text{};
    if (!status_.slow && rate < kSlowFraction * request_.rate) {
      status_.slow = true;
      std::snprintf(text.data(), text.size(),
                    "The camera delivers %.1f %s images per second instead of %d: not enough USB "
                    "bandwidth or processor time. Connect it to a USB controller of its own "
                    "(lsusb -t) without a hub, or decrease rate, width, height",
                    rate, toString(kind), request_.rate);
      status_.message = text.data();
      listener_.onMessage(Severity::kWarning, status_.message);
    }
  }
  const auto isFast = [&](StreamKind kind) {
    return !stream(kind).running || stream(kind).monitor.rate() > kFastFraction * request_.rate;
  };
  if (status_.slow && isFast(StreamKind::kColor) && isFast(StreamKind::kDepth)) {
    status_.slow = false;
    status_.message = "The camera delivers its full rate again";
    listener_.onMessage(Severity::kInfo, status_.message);
  }
}

void CameraSession::applySettings() {
  settings_pending_ = false;
  if (!status_.device.has_camera_settings) {
    return;  // reported when the device was opened
  }
  device_->applySettings(wanted_settings_);
  status_.settings = device_->settings();
  const std::string difference = disobeyed(wanted_settings_, status_.settings);
  if (!difference.empty()) {
    listener_.onMessage(Severity::kWarning,
                        "The camera did not accept all settings: " + difference);
  }
  listener_.onSettings(status_.settings);
}

CameraStatus CameraSession::status() const {
  CameraStatus status = status_;
  status.listener_fault = listener_.fault();
  status.clock_skew = clock_filter_.skew();
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    const RateMonitor& monitor = streams_[i].monitor;
    status.streams[i] = {monitor.rate(), monitor.frames(), monitor.dropped()};
  }
  return status;
}

}  // namespace mivo
