// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mivo {

enum class StreamKind { kColor, kDepth };
constexpr int kStreamKinds = 2;

const char* toString(StreamKind kind);  ///< color, depth

/// An image of the driver. The memory belongs to the driver and is valid during the callback only:
/// copy the pixels to keep them.
struct ImageView {
  StreamKind kind = StreamKind::kColor;
  const std::uint8_t* data = nullptr;  ///< color: RGB, 8 bits each; depth: 16 bits, 0: no reading
  int width = 0;                       ///< pixels
  int height = 0;                      ///< pixels
  std::size_t stride = 0;              ///< bytes from row to row
  double depth_unit = 0.0;             ///< meters per step of a depth image
  std::uint64_t device_stamp = 0;      ///< microseconds of the device's own clock
  int index = 0;                       ///< counts frames; a gap is a dropped frame
};

/// Settings of the color camera. An absent value is not changed (when set) or not known (when
/// read).
struct CameraSettings {
  std::optional<bool> auto_exposure;
  std::optional<bool> auto_white_balance;
  std::optional<int> exposure;  ///< in the device's own steps; acts with auto exposure off
  std::optional<int> gain;      ///< percent for PrimeSense devices; acts with auto exposure off
};

bool operator==(const CameraSettings& a, const CameraSettings& b);
inline bool operator!=(const CameraSettings& a, const CameraSettings& b) {
  return !(a == b);
}

/// "auto exposure off, exposure 30"; for messages.
std::string toString(const CameraSettings& settings);

/// Lists each requested value that the camera did not accept; empty if it accepted all.
std::string disobeyed(const CameraSettings& asked, const CameraSettings& actual);

/// Requested camera and mode.
struct DeviceRequest {
  /// Empty or "any"; "#1" for the first device; a serial number; an OpenNI2 URI; or the path of
  /// a recording (.oni).
  std::string address;
  int width = 640;            ///< pixels, of both images
  int height = 480;           ///< pixels
  int rate = 30;              ///< Hz
  double depth_unit = 0.001;  ///< meters: 0.001 or 0.0001
  bool registration = true;   ///< depth registered to color by the device
  bool synchronize = true;    ///< expose color and depth together, if the device supports it
  bool repeat = false;        ///< play a recording in a loop
};

struct DeviceDescription {
  std::string uri;
  std::string name;    ///< vendor and product
  std::string serial;  ///< empty when the device has none
  bool is_recording = false;
  bool has_camera_settings = false;
  double color_field_of_view = 0.0;  ///< horizontal, rad; 0: not known
  double depth_field_of_view = 0.0;  ///< horizontal, rad; 0: not known
  /// Nonessential settings that the device rejected, one line each.
  std::vector<std::string> notes;
};

/// An open camera. Used by one thread; every call may wait for USB; failures are DeviceErrors.
class CameraDevice {
 public:
  virtual ~CameraDevice() = default;

  virtual const DeviceDescription& description() const = 0;

  /// Starting a running stream or stopping a stopped one has no effect.
  virtual void start(StreamKind kind) = 0;
  virtual void stop(StreamKind kind) = 0;

  /// False once the device was unplugged; never waits.
  virtual bool isConnected() const = 0;

  /// Passes the next image of the running streams to the callback. False: none arrived within this
  /// time.
  virtual bool read(std::chrono::milliseconds timeout,
                    const std::function<void(const ImageView&)>& callback) = 0;

  /// Applies the given values. Devices ignore them unless the color stream has delivered an image.
  virtual void applySettings(const CameraSettings& settings) = 0;

  /// Current values reported by the device.
  virtual CameraSettings settings() const = 0;
};

/// Opens a camera or throws DeviceError.
using DeviceFactory = std::function<std::unique_ptr<CameraDevice>(const DeviceRequest&)>;

}  // namespace mivo
