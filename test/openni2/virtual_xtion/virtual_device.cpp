// SPDX-License-Identifier: BSD-3-Clause
#include "virtual_device.h"

#include <PS1080.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>

namespace virtual_xtion {
namespace {

constexpr std::int64_t kSecond = 1000000000;  // ns
constexpr std::int64_t kMicrosecond = 1000;
constexpr double kMillion = 1e6;
// Depth that is not registered is seen from elsewhere: so many pixels to the side.
constexpr int kUnregisteredShift = 8;
// Streams that are not synchronized run at the same rate, out of step by this.
constexpr std::int64_t kOutOfStep = 7000000;
constexpr std::int64_t kSlice = 5000000;  // longest sleep, so that the control acts soon

std::int64_t hostNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

// Whole seconds apart, for nanoseconds since 1970 times 30 do not fit into 64 bits.
std::int64_t timeOf(std::int64_t tick) {
  return tick / kRate * kSecond + tick % kRate * kSecond / kRate;
}

// Latest tick at or before a time.
std::int64_t tickAt(std::int64_t time) {
  return time / kSecond * kRate + time % kSecond * kRate / kSecond;
}

}  // namespace

Control SharedControl::get() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return control_;
}

void SharedControl::set(const Control& control) {
  const std::lock_guard<std::mutex> lock(mutex_);
  control_ = control;
}

VirtualDevice::VirtualDevice(const SharedControl& control, int number)
    : control_(control),
      number_(number),
      sequence_(control.get().folder),
      power_on_(hostNow()),
      color_modes_{{ONI_PIXEL_FORMAT_RGB888, kWidth, kHeight, kRate}},
      depth_modes_{{ONI_PIXEL_FORMAT_DEPTH_1_MM, kWidth, kHeight, kRate},
                   {ONI_PIXEL_FORMAT_DEPTH_100_UM, kWidth, kHeight, kRate}} {
  if (control.get().color) {
    sensors_.push_back(
        {ONI_SENSOR_COLOR, static_cast<int>(color_modes_.size()), color_modes_.data()});
  }
  sensors_.push_back(
      {ONI_SENSOR_DEPTH, static_cast<int>(depth_modes_.size()), depth_modes_.data()});
  for (std::size_t i = 0; control.get().decode_first && i < sequence_.size(); ++i) {
    sequence_.images(i);
  }
  thread_ = std::thread(&VirtualDevice::run, this);
}

VirtualDevice::~VirtualDevice() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

OniStatus VirtualDevice::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  *sensors = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* VirtualDevice::createStream(OniSensorType sensor) {
  const bool known = std::any_of(sensors_.begin(), sensors_.end(), [&](const OniSensorInfo& info) {
    return info.sensorType == sensor;
  });
  if (!known) {
    return nullptr;
  }
  auto* stream = new VirtualStream(*this, sensor, control_.get(), sequence_.horizontalFieldOfView(),
                                   sequence_.verticalFieldOfView());
  const std::lock_guard<std::mutex> lock(mutex_);
  streams_[sensor] = stream;
  return stream;
}

void VirtualDevice::destroyStream(oni::driver::StreamBase* stream) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto it = streams_.begin(); it != streams_.end();) {
      it = it->second == stream ? streams_.erase(it) : std::next(it);
    }
  }
  delete stream;
}

OniStatus VirtualDevice::setProperty(int id, const void* data, int size) {
  if (id == XN_MODULE_PROPERTY_FIRMWARE_FRAME_SYNC) {
    std::uint64_t on = 0;
    if (size != static_cast<int>(sizeof(on))) {
      return ONI_STATUS_BAD_PARAMETER;
    }
    std::memcpy(&on, data, sizeof(on));
    synchronized_ = on != 0;
    return ONI_STATUS_OK;
  }
  OniImageRegistrationMode mode{};
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || size != static_cast<int>(sizeof(mode))) {
    return ONI_STATUS_NOT_SUPPORTED;
  }
  std::memcpy(&mode, data, sizeof(mode));
  if (!isImageRegistrationModeSupported(mode)) {
    return ONI_STATUS_NOT_SUPPORTED;
  }
  registered_ = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  return ONI_STATUS_OK;
}

OniStatus VirtualDevice::getProperty(int id, void* data, int* size) {
  if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) {
    const OniImageRegistrationMode mode =
        registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF;
    std::memcpy(data, &mode, sizeof(mode));
    *size = static_cast<int>(sizeof(mode));
    return ONI_STATUS_OK;
  }
  if (id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER) {
    const std::string serial = "VIRTUAL" + std::to_string(number_);
    if (*size <= static_cast<int>(serial.size())) {
      return ONI_STATUS_BAD_PARAMETER;
    }
    std::memcpy(data, serial.c_str(), serial.size() + 1);
    *size = static_cast<int>(serial.size()) + 1;
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniBool VirtualDevice::isPropertySupported(int id) {
  return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER ||
                 id == XN_MODULE_PROPERTY_FIRMWARE_FRAME_SYNC
             ? TRUE
             : FALSE;
}

OniBool VirtualDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || control_.get().registration ? TRUE : FALSE;
}

void VirtualDevice::run() {
  std::int64_t tick = tickAt(hostNow()) + 1;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_) {
    const std::int64_t now = hostNow();
    std::int64_t due = timeOf(tick);
    if (!under_way_.empty()) {
      due = std::min(due, under_way_.begin()->first);
    }
    if (now < due) {
      wake_.wait_for(lock, std::chrono::nanoseconds(std::min(due - now, kSlice)));
      continue;
    }
    deliverDue(now);
    if (now >= timeOf(tick)) {
      take(tick, control_.get());
      deliverDue(hostNow());
      // Between two images, so that none is late because it has to be decoded.
      sequence_.images(std::min(last_frame_.value_or(0) + 1, sequence_.size() - 1));
      // A machine that was away for longer than an image takes loses the ones in between.
      tick = std::max(tick + 1, tickAt(hostNow()) + 1);
    }
  }
}

bool VirtualDevice::isLost(std::int64_t tick, const Control& control) const {
  const bool through_usb = tick * control.rate / kRate != (tick - 1) * control.rate / kRate;
  return !control.present || !through_usb || tick % control.pace != 0 ||
         (control.drop_every > 0 && tick % control.drop_every == 0);
}

std::size_t VirtualDevice::nextFrame(const Control& control) const {
  if (!last_frame_) {
    return 0;
  }
  return std::max(*last_frame_, std::min({*last_frame_ + 1, control.until, sequence_.size() - 1}));
}

// Takes the image of one tick: called with mutex_ held.
void VirtualDevice::take(std::int64_t tick, const Control& control) {
  if (isLost(tick, control)) {
    return;
  }
  const std::size_t frame = nextFrame(control);
  const ServedSequence::Images& images = sequence_.images(frame);
  const int index = static_cast<int>(tick - tickAt(power_on_));
  std::exponential_distribution<double> delay(1.0);
  for (const auto& [sensor, stream] : streams_) {
    const bool is_color = sensor == ONI_SENSOR_COLOR;
    if (!stream->isRunning() || (is_color ? control.color_stalls : control.depth_stalls)) {
      continue;
    }
    const std::int64_t host = timeOf(tick) + (is_color || synchronized_ ? 0 : kOutOfStep);
    const std::uint64_t stamp = deviceTime(host, control);
    const double late = control.jitter * delay(random_) + (is_color ? 0.0 : control.depth_delay);
    last_frame_ = frame;
    under_way_.emplace(host + std::llround(late * static_cast<double>(kSecond)),
                       Delivery{sensor, seen(sensor, *stream, images), stamp, index});
    if (is_color) {
      logTruth(stamp, host, frame, control);
    }
  }
}

cv::Mat VirtualDevice::seen(OniSensorType sensor, VirtualStream& stream,
                            const ServedSequence::Images& images) {
  cv::Mat image = images.color;
  if (sensor == ONI_SENSOR_DEPTH) {
    image = stream.isTenths() ? images.depth_tenths : images.depth_millimeters;
    if (!registered_) {
      cv::Mat shifted = cv::Mat::zeros(image.size(), image.type());
      image.colRange(kUnregisteredShift, image.cols)
          .copyTo(shifted.colRange(0, image.cols - kUnregisteredShift));
      image = shifted;
    }
  }
  if (stream.isMirrored()) {
    cv::Mat mirrored;
    cv::flip(image, mirrored, 1);
    image = mirrored;
  }
  return image;
}

std::uint64_t VirtualDevice::deviceTime(std::int64_t host, const Control& control) const {
  const double rate = 1.0 + control.clock_ppm / kMillion;
  return static_cast<std::uint64_t>(
      std::llround(static_cast<double>(host - power_on_) * rate / kMicrosecond));
}

// Called with mutex_ held, which keeps the streams alive.
void VirtualDevice::deliverDue(std::int64_t now) {
  while (!under_way_.empty() && under_way_.begin()->first <= now) {
    const Delivery delivery = under_way_.begin()->second;
    under_way_.erase(under_way_.begin());
    const auto stream = streams_.find(delivery.sensor);
    if (stream != streams_.end()) {
      stream->second->deliver(delivery.image, delivery.stamp, delivery.index);
    }
  }
}

void VirtualDevice::logTruth(std::uint64_t stamp, std::int64_t host, std::size_t frame,
                             const Control& control) {
  if (control.truth.empty()) {
    return;
  }
  if (!truth_.is_open()) {
    truth_.open(control.truth, std::ios::app);
  }
  truth_ << stamp << ' ' << host << ' ' << frame << std::endl;
}

}  // namespace virtual_xtion
