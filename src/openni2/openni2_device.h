// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "openni2/camera_device.h"

namespace mivo {

/// A camera or a recording through libOpenNI2. While one exists, the library is initialized; when
/// the last one goes, it is shut down, so that opening again looks for devices anew.
class OpenNi2Device : public CameraDevice {
 public:
  /// Throws DeviceError.
  static std::unique_ptr<CameraDevice> open(const DeviceRequest& request);
  ~OpenNi2Device() override;

  const DeviceDescription& description() const override;
  void start(StreamKind kind) override;
  void stop(StreamKind kind) override;
  bool isConnected() const override;
  bool read(std::chrono::milliseconds timeout,
            const std::function<void(const ImageView&)>& callback) override;
  void applySettings(const CameraSettings& settings) override;
  CameraSettings settings() const override;

 private:
  class Implementation;
  explicit OpenNi2Device(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mivo
