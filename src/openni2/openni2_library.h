// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "openni2/camera_device.h"

namespace mivo {

/// libOpenNI2, initialized while an object exists: all cameras of the process share one.
class OpenNi2Library {
 public:
  /// Throws DeviceError when the library finds no driver.
  static std::shared_ptr<OpenNi2Library> acquire();
  ~OpenNi2Library();
  OpenNi2Library(const OpenNi2Library&) = delete;
  OpenNi2Library& operator=(const OpenNi2Library&) = delete;

  struct Listed {
    std::string uri;
    std::string name;
  };
  std::vector<Listed> devices() const;

 private:
  OpenNi2Library();
};

/// The SDK's last error text in this thread, as one line.
std::string sdkError();

/// Words separated by single spaces, without a full stop or exclamation mark at the end.
std::string oneLine(const std::string& text);

}  // namespace mivo
