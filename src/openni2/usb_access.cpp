// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/usb_access.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>

namespace mivo {
namespace {

struct Phrase {
  const char* text;  ///< lower case
  DeviceFault fault;
};

// Parts of what libOpenNI2 and its drivers say when a device does not open.
constexpr std::array<Phrase, 9> kPhrases{{{"access denied", DeviceFault::kNoPermission},
                                          {"access is denied", DeviceFault::kNoPermission},
                                          {"permission", DeviceFault::kNoPermission},
                                          {"in use", DeviceFault::kInUse},
                                          {"is busy", DeviceFault::kInUse},
                                          // The kernel refuses the interface that another process
                                          // has claimed; the SDK knows no more than this.
                                          {"failed to set usb interface", DeviceFault::kInUse},
                                          {"failed to open the usb device", DeviceFault::kUsb},
                                          {"usb", DeviceFault::kUsb},
                                          {"no devices found", DeviceFault::kNoDevice}}};

}  // namespace

std::optional<std::string> usbNode(const std::string& uri, const std::string& root) {
  unsigned vendor = 0;
  unsigned product = 0;
  unsigned bus = 0;
  unsigned address = 0;
  int length = 0;
  const int read =
      std::sscanf(uri.c_str(), "%4x/%4x@%3u/%3u%n", &vendor, &product, &bus, &address, &length);
  if (read != 4 || static_cast<std::size_t>(length) != uri.size()) {
    return std::nullopt;
  }
  std::array<char, 16> name{};
  std::snprintf(name.data(), name.size(), "/%03u/%03u", bus, address);
  return root + name.data();
}

bool mayUse(const std::string& node) {
  return access(node.c_str(), R_OK | W_OK) == 0 || errno != EACCES;
}

DeviceFault classifyOpenFailure(const std::string& uri, const std::string& sdk_text,
                                const std::string& usb_root) {
  const auto node = usbNode(uri, usb_root);
  if (node && !mayUse(*node)) {
    return DeviceFault::kNoPermission;
  }
  std::string text = sdk_text;
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Phrase& phrase : kPhrases) {
    if (text.find(phrase.text) != std::string::npos) {
      return phrase.fault;
    }
  }
  return DeviceFault::kWrongAddress;
}

}  // namespace mivo
