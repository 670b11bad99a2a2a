// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "openni2/camera_device.h"

namespace mivo {

enum class Severity { kInfo, kWarning, kError };

/// Hears what a CameraSession does, in the thread that calls CameraSession::step.
class CameraListener {
 public:
  virtual ~CameraListener() = default;
  /// @param stamp host time at which the image was taken, ns
  virtual void onImage(const ImageView& image, std::int64_t stamp) = 0;
  /// Something changed that the user should read: one line, once per change.
  virtual void onMessage(Severity severity, const std::string& line) = 0;
  /// A device was opened.
  virtual void onDevice(const DeviceDescription& device) = 0;
  /// The camera's true settings, after they were applied.
  virtual void onSettings(const CameraSettings& settings) = 0;
};

/// Hands everything on to another listener. What that one throws is no fault of the camera, which
/// goes on: it is told as an error, once until it changes, and kept.
class GuardedListener : public CameraListener {
 public:
  explicit GuardedListener(CameraListener& listener) : listener_(listener) {}

  void onImage(const ImageView& image, std::int64_t stamp) override;
  void onMessage(Severity severity, const std::string& line) override;
  void onDevice(const DeviceDescription& device) override;
  void onSettings(const CameraSettings& settings) override;

  /// What the listener threw last; empty: nothing.
  const std::string& fault() const { return fault_; }

 private:
  template <typename Call>
  void guard(Call&& call);
  void failed(const std::string& fault);

  CameraListener& listener_;
  std::string fault_;
};

}  // namespace mivo
