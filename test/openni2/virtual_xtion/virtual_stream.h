// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Driver/OniDriverAPI.h>

#include <cstdint>
#include <mutex>
#include <opencv2/core/mat.hpp>

#include "control_file.h"

namespace virtual_xtion {

class VirtualDevice;

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kRate = 30;

/// One image stream. Its device calls deliver() from the sensor thread; the rest is called by the
/// SDK from the application's threads.
class VirtualStream : public oni::driver::StreamBase {
 public:
  VirtualStream(VirtualDevice& device, OniSensorType sensor, const Control& control,
                double horizontal_fov, double vertical_fov);

  OniStatus start() override;
  void stop() override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  void notifyAllProperties() override;

  VirtualDevice& device() const { return device_; }
  bool isRunning();
  bool isTenths();  ///< depth in 0.1 mm
  bool isMirrored();

  /// Hands the image to the SDK if the stream runs.
  void deliver(const cv::Mat& image, std::uint64_t stamp, int index);

 private:
  bool isColor() const { return sensor_ == ONI_SENSOR_COLOR; }
  int bytesPerPixel() const { return isColor() ? 3 : 2; }
  OniStatus setSetting(int id, const void* data, int size);

  VirtualDevice& device_;
  const OniSensorType sensor_;
  const bool has_settings_;
  const bool is_deaf_;
  const float horizontal_fov_;
  const float vertical_fov_;

  std::mutex delivery_;  ///< held while an image is handed on: stop() waits for it
  std::mutex mutex_;     ///< guards what follows, never held while the SDK is called
  bool running_ = false;
  bool delivered_ = false;  ///< since the start
  OniVideoMode mode_;
  OniBool mirrored_ = TRUE;  // as the real sensor is
  OniCropping cropping_{};
  OniBool auto_exposure_ = TRUE;
  OniBool auto_white_balance_ = TRUE;
  int exposure_ = 0;
  int gain_ = 0;
};

}  // namespace virtual_xtion
