// SPDX-License-Identifier: BSD-3-Clause
#include "virtual_stream.h"

#include <algorithm>
#include <cstring>
#include <opencv2/core.hpp>

#include "virtual_device.h"

namespace virtual_xtion {
namespace {

// What the camera starts with, and what its automatic keeps setting.
constexpr int kDefaultExposure = 33;
constexpr int kDefaultGain = 100;
constexpr int kMaxDepthMillimeters = 10000;

template <typename Value>
OniStatus give(const Value& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof(Value))) {
    return ONI_STATUS_BAD_PARAMETER;
  }
  std::memcpy(data, &value, sizeof(Value));
  *size = static_cast<int>(sizeof(Value));
  return ONI_STATUS_OK;
}

template <typename Value>
bool take(Value& value, const void* data, int size) {
  if (size != static_cast<int>(sizeof(Value))) {
    return false;
  }
  std::memcpy(&value, data, sizeof(Value));
  return true;
}

}  // namespace

VirtualStream::VirtualStream(VirtualDevice& device, OniSensorType sensor, const Control& control,
                             double horizontal_fov, double vertical_fov)
    : device_(device),
      sensor_(sensor),
      has_settings_(control.settings && sensor == ONI_SENSOR_COLOR),
      is_deaf_(control.deaf),
      horizontal_fov_(static_cast<float>(horizontal_fov)),
      vertical_fov_(static_cast<float>(vertical_fov)),
      mode_{sensor == ONI_SENSOR_COLOR ? ONI_PIXEL_FORMAT_RGB888 : ONI_PIXEL_FORMAT_DEPTH_1_MM,
            kWidth, kHeight, kRate},
      exposure_(kDefaultExposure),
      gain_(kDefaultGain) {}

OniStatus VirtualStream::start() {
  device_.resetSynchronization();
  const std::lock_guard<std::mutex> lock(mutex_);
  running_ = true;
  delivered_ = false;
  // Starting sets the sensor up anew: earlier settings are lost, as on the real one.
  auto_exposure_ = TRUE;
  auto_white_balance_ = TRUE;
  exposure_ = kDefaultExposure;
  gain_ = kDefaultGain;
  return ONI_STATUS_OK;
}

void VirtualStream::stop() {
  device_.resetSynchronization();
  const std::lock_guard<std::mutex> delivery(delivery_);
  const std::lock_guard<std::mutex> lock(mutex_);
  running_ = false;
}

OniStatus VirtualStream::setProperty(int id, const void* data, int size) {
  const std::lock_guard<std::mutex> lock(mutex_);
  OniVideoMode mode{};
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      if (!take(mode, data, size) || mode.resolutionX != kWidth || mode.resolutionY != kHeight ||
          mode.fps != kRate) {
        return ONI_STATUS_BAD_PARAMETER;
      }
      mode_ = mode;
      return ONI_STATUS_OK;
    case ONI_STREAM_PROPERTY_MIRRORING:
      return take(mirrored_, data, size) ? ONI_STATUS_OK : ONI_STATUS_BAD_PARAMETER;
    case ONI_STREAM_PROPERTY_CROPPING:
      return ONI_STATUS_NOT_SUPPORTED;
    default:
      return has_settings_ ? setSetting(id, data, size) : ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus VirtualStream::setSetting(int id, const void* data, int size) {
  int value = 0;
  if (!take(value, data, size)) {
    return ONI_STATUS_BAD_PARAMETER;
  }
  if (is_deaf_ || !delivered_) {
    return ONI_STATUS_OK;  // the real sensor says so too, and forgets it
  }
  switch (id) {
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      auto_exposure_ = value;
      break;
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      auto_white_balance_ = value;
      break;
    case ONI_STREAM_PROPERTY_EXPOSURE:
      exposure_ = auto_exposure_ ? exposure_ : value;
      break;
    case ONI_STREAM_PROPERTY_GAIN:
      gain_ = auto_exposure_ ? gain_ : value;
      break;
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
  return ONI_STATUS_OK;
}

OniStatus VirtualStream::getProperty(int id, void* data, int* size) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (has_settings_) {
    switch (id) {
      case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
        return give(auto_exposure_, data, size);
      case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
        return give(auto_white_balance_, data, size);
      case ONI_STREAM_PROPERTY_EXPOSURE:
        return give(exposure_, data, size);
      case ONI_STREAM_PROPERTY_GAIN:
        return give(gain_, data, size);
      default:
        break;
    }
  }
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return give(mode_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return give(horizontal_fov_, data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return give(vertical_fov_, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return give(mirrored_, data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return give(kWidth * bytesPerPixel(), data, size);
    case ONI_STREAM_PROPERTY_CROPPING:
      return give(cropping_, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return isColor() ? ONI_STATUS_NOT_SUPPORTED : give(kMaxDepthMillimeters, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return isColor() ? ONI_STATUS_NOT_SUPPORTED : give(0, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniBool VirtualStream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_MIRRORING:
    case ONI_STREAM_PROPERTY_STRIDE:
    case ONI_STREAM_PROPERTY_CROPPING:
      return TRUE;
    case ONI_STREAM_PROPERTY_MAX_VALUE:
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return isColor() ? FALSE : TRUE;
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
    case ONI_STREAM_PROPERTY_EXPOSURE:
    case ONI_STREAM_PROPERTY_GAIN:
      return has_settings_ ? TRUE : FALSE;
    default:
      return FALSE;
  }
}

void VirtualStream::notifyAllProperties() {
  // A recorder writes what is raised here, and a player needs stride and cropping to play at all.
  for (int id : {ONI_STREAM_PROPERTY_VIDEO_MODE, ONI_STREAM_PROPERTY_HORIZONTAL_FOV,
                 ONI_STREAM_PROPERTY_VERTICAL_FOV, ONI_STREAM_PROPERTY_MIRRORING,
                 ONI_STREAM_PROPERTY_STRIDE, ONI_STREAM_PROPERTY_CROPPING,
                 ONI_STREAM_PROPERTY_MAX_VALUE, ONI_STREAM_PROPERTY_MIN_VALUE}) {
    char data[sizeof(OniVideoMode) + sizeof(OniCropping)];
    int size = static_cast<int>(sizeof(data));
    if (getProperty(id, data, &size) == ONI_STATUS_OK) {
      raisePropertyChanged(id, data, size);
    }
  }
}

bool VirtualStream::isRunning() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return running_;
}

bool VirtualStream::isTenths() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM;
}

bool VirtualStream::isMirrored() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return mirrored_ != FALSE;
}

void VirtualStream::deliver(const cv::Mat& image, std::uint64_t stamp, int index) {
  const std::lock_guard<std::mutex> delivery(delivery_);
  if (!isRunning()) {
    return;
  }
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr) {
    return;
  }
  const int stride = kWidth * bytesPerPixel();
  frame->dataSize = stride * kHeight;
  for (int y = 0; y < kHeight; ++y) {
    std::memcpy(static_cast<char*>(frame->data) + y * stride, image.ptr(y),
                static_cast<std::size_t>(stride));
  }
  frame->sensorType = sensor_;
  frame->timestamp = stamp;
  frame->frameIndex = index;
  frame->width = kWidth;
  frame->height = kHeight;
  frame->croppingEnabled = FALSE;
  frame->cropOriginX = 0;
  frame->cropOriginY = 0;
  frame->stride = stride;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    frame->videoMode = mode_;
    delivered_ = true;
  }
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

}  // namespace virtual_xtion
