// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/camera_device.h"

namespace mivo {
namespace {

std::string toText(bool value) {
  return value ? "on" : "off";
}
std::string toText(int value) {
  return std::to_string(value);
}

template <typename Value>
void append(std::string& text, const char* name, const std::optional<Value>& value) {
  if (value) {
    text += (text.empty() ? "" : ", ") + std::string(name) + " " + toText(*value);
  }
}

template <typename Value>
void appendDifference(std::string& text, const char* name, const std::optional<Value>& asked,
                      const std::optional<Value>& actual) {
  if (asked && asked != actual) {
    text += (text.empty() ? "" : ", ") + std::string(name) + " stays " +
            (actual ? toText(*actual) : "unknown") + " instead of " + toText(*asked);
  }
}

}  // namespace

const char* toString(StreamKind kind) {
  return kind == StreamKind::kColor ? "color" : "depth";
}

bool operator==(const CameraSettings& a, const CameraSettings& b) {
  return a.auto_exposure == b.auto_exposure && a.auto_white_balance == b.auto_white_balance &&
         a.exposure == b.exposure && a.gain == b.gain;
}

std::string toString(const CameraSettings& settings) {
  std::string text;
  append(text, "auto exposure", settings.auto_exposure);
  append(text, "auto white balance", settings.auto_white_balance);
  append(text, "exposure", settings.exposure);
  append(text, "gain", settings.gain);
  return text;
}

std::string disobeyed(const CameraSettings& asked, const CameraSettings& actual) {
  std::string text;
  appendDifference(text, "auto exposure", asked.auto_exposure, actual.auto_exposure);
  appendDifference(text, "auto white balance", asked.auto_white_balance, actual.auto_white_balance);
  if (!actual.auto_exposure.value_or(false)) {  // otherwise the camera chooses these two
    appendDifference(text, "exposure", asked.exposure, actual.exposure);
    appendDifference(text, "gain", asked.gain, actual.gain);
  }
  return text;
}

}  // namespace mivo
