// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/openni2_library.h"

#include <OpenNI.h>

#include <mutex>
#include <sstream>

#include "openni2/device_error.h"

namespace mivo {

std::shared_ptr<OpenNi2Library> OpenNi2Library::acquire() {
  static std::mutex mutex;
  static std::weak_ptr<OpenNi2Library> shared;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<OpenNi2Library> library = shared.lock();
  if (!library) {
    // Under the mutex from initialize to shutdown: the library's are not made for two threads.
    library = std::shared_ptr<OpenNi2Library>(new OpenNi2Library(), [](OpenNi2Library* pointer) {
      const std::lock_guard<std::mutex> delete_lock(mutex);
      delete pointer;
    });
    shared = library;
  }
  return library;
}

OpenNi2Library::OpenNi2Library() {
  if (openni::OpenNI::initialize() != openni::STATUS_OK) {
    const std::string text = sdkError();
    openni::OpenNI::shutdown();
    throw DeviceError(DeviceFault::kNoDriver, "OpenNI2 does not start: " + text);
  }
}

OpenNi2Library::~OpenNi2Library() {
  openni::OpenNI::shutdown();
}

std::vector<OpenNi2Library::Listed> OpenNi2Library::devices() const {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<Listed> devices;
  for (int i = 0; i < infos.getSize(); ++i) {
    devices.push_back(
        {infos[i].getUri(), oneLine(std::string(infos[i].getVendor()) + " " + infos[i].getName())});
  }
  return devices;
}

std::string sdkError() {
  const std::string text = oneLine(openni::OpenNI::getExtendedError());
  return text.empty() ? "the SDK gives no reason" : text;
}

std::string oneLine(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    line += (line.empty() ? "" : " ") + word;
  }
  while (!line.empty() && (line.back() == '.' || line.back() == '!')) {
    line.pop_back();
  }
  return line;
}

}  // namespace mivo
