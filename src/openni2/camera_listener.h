// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "openni2/camera_device.h"

namespace mivo {

enum class Severity { kInfo, kWarning, kError };

/// Receives events of a CameraSession in the thread that calls CameraSession::step.
class CameraListener {
 public:
  virtual ~CameraListener() = default;
  /// @param stamp host time at which the image was taken, ns
  virtual void onImage(const ImageView& image, std::int64_t stamp) = 0;
  /// A message for the user: one line, once per change.
  virtual void onMessage(Severity severity, const std::string& line) = 0;
  /// A device was opened.
  virtual void onDevice(const DeviceDescription& device) = 0;
  /// The camera's true settings, after they were applied.
  virtual void onSettings(const CameraSettings& settings) = 0;
};

/// Forwards events to another listener and catches its exceptions, so that the camera continues. An
/// exception is reported as an error, once until it changes, and stored.
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
