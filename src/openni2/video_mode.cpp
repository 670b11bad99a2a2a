// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/video_mode.h"

#include <cmath>
#include <string>

#include "openni2/device_error.h"
#include "openni2/openni2_library.h"

namespace mivo {
namespace {

constexpr double kMillimeter = 1e-3;
constexpr double kTenthOfMillimeter = 1e-4;

const char* nameOf(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
      return "depth in 1 mm";
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return "depth in 0.1 mm";
    case openni::PIXEL_FORMAT_RGB888:
      return "RGB888";
    case openni::PIXEL_FORMAT_YUV422:
      return "YUV422";
    case openni::PIXEL_FORMAT_YUYV:
      return "YUYV";
    case openni::PIXEL_FORMAT_JPEG:
      return "JPEG";
    default:
      return "another format";
  }
}

std::string describe(const openni::VideoMode& mode) {
  return std::to_string(mode.getResolutionX()) + "x" + std::to_string(mode.getResolutionY()) +
         " at " + std::to_string(mode.getFps()) + " Hz, " + nameOf(mode.getPixelFormat());
}

openni::PixelFormat wantedFormat(StreamKind kind, const DeviceRequest& request) {
  if (kind == StreamKind::kColor) {
    return openni::PIXEL_FORMAT_RGB888;
  }
  const double middle = std::sqrt(kMillimeter * kTenthOfMillimeter);
  return request.depth_unit > middle ? openni::PIXEL_FORMAT_DEPTH_1_MM
                                     : openni::PIXEL_FORMAT_DEPTH_100_UM;
}

bool isSame(const openni::VideoMode& a, const openni::VideoMode& b) {
  return a.getResolutionX() == b.getResolutionX() && a.getResolutionY() == b.getResolutionY() &&
         a.getFps() == b.getFps() && a.getPixelFormat() == b.getPixelFormat();
}

bool isUsable(const openni::VideoMode& mode, StreamKind kind) {
  const openni::PixelFormat format = mode.getPixelFormat();
  return kind == StreamKind::kColor ? format == openni::PIXEL_FORMAT_RGB888
                                    : format == openni::PIXEL_FORMAT_DEPTH_1_MM ||
                                          format == openni::PIXEL_FORMAT_DEPTH_100_UM;
}

void acceptRecorded(const openni::VideoStream& stream, StreamKind kind) {
  const openni::VideoMode mode = stream.getVideoMode();
  if (!isUsable(mode, kind)) {
    throw DeviceError(DeviceFault::kBadRecording, std::string("The recording's ") + toString(kind) +
                                                      " is " + describe(mode) +
                                                      ", which cannot be used");
  }
}

}  // namespace

void setVideoMode(openni::VideoStream& stream, StreamKind kind, const DeviceRequest& request,
                  const DeviceDescription& device) {
  if (device.is_recording) {
    acceptRecorded(stream, kind);
    return;
  }
  const openni::PixelFormat format = wantedFormat(kind, request);
  std::string offered;
  const auto& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    const openni::VideoMode& mode = modes[i];
    if (mode.getResolutionX() == request.width && mode.getResolutionY() == request.height &&
        mode.getFps() == request.rate && mode.getPixelFormat() == format) {
      // Some drivers refuse even the mode that they are in.
      if (!isSame(stream.getVideoMode(), mode) && stream.setVideoMode(mode) != openni::STATUS_OK) {
        throw DeviceError(DeviceFault::kUsb,
                          device.name + " refuses " + describe(mode) + ": " + sdkError());
      }
      return;
    }
    if (isUsable(mode, kind)) {
      offered += (offered.empty() ? "" : "; ") + describe(mode);
    }
  }
  throw DeviceError(DeviceFault::kNoMode,
                    device.name + " does not offer " + std::to_string(request.width) + "x" +
                        std::to_string(request.height) + " at " + std::to_string(request.rate) +
                        " Hz, " + nameOf(format) + " (" + toString(kind) +
                        " modes: " + (offered.empty() ? "none that can be used" : offered) + ")");
}

ImageView viewOf(openni::VideoFrameRef& frame) {
  ImageView view;
  view.kind =
      frame.getSensorType() == openni::SENSOR_COLOR ? StreamKind::kColor : StreamKind::kDepth;
  view.data = static_cast<const std::uint8_t*>(frame.getData());
  view.width = frame.getWidth();
  view.height = frame.getHeight();
  view.stride = static_cast<std::size_t>(frame.getStrideInBytes());
  if (view.kind == StreamKind::kDepth) {
    view.depth_unit = frame.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM
                          ? kTenthOfMillimeter
                          : kMillimeter;
  }
  view.device_stamp = frame.getTimestamp();
  view.index = frame.getFrameIndex();
  return view;
}

}  // namespace mivo
