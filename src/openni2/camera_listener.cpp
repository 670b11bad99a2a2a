// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/camera_listener.h"

#include <exception>

namespace mivo {

template <typename Call>
void GuardedListener::guard(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) {
    failed(error.what());
  }
}

void GuardedListener::failed(const std::string& fault) {
  if (fault == fault_) {
    return;
  }
  fault_ = fault;
  try {
    listener_.onMessage(Severity::kError, "Cannot use the data of the camera: " + fault);
  } catch (const std::exception& error) {
    fault_ = error.what();  // only fault() can report it now
  }
}

void GuardedListener::onImage(const ImageView& image, std::int64_t stamp) {
  guard([&] { listener_.onImage(image, stamp); });
}

void GuardedListener::onMessage(Severity severity, const std::string& line) {
  guard([&] { listener_.onMessage(severity, line); });
}

void GuardedListener::onDevice(const DeviceDescription& device) {
  guard([&] { listener_.onDevice(device); });
}

void GuardedListener::onSettings(const CameraSettings& settings) {
  guard([&] { listener_.onSettings(settings); });
}

}  // namespace mivo
