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

const char* toString(StreamKind kind);  ///< colour, depth

/// An image as the driver delivered it. The memory belongs to the driver and is valid only inside
/// of the callback that gets it: copy what is to be kept.
struct ImageView {
  StreamKind kind = StreamKind::kColor;
  const std::uint8_t* data = nullptr;  ///< colour: RGB, 8 bits each; depth: 16 bits, 0: no reading
  int width = 0;                       ///< pixels
  int height = 0;                      ///< pixels
  std::size_t stride = 0;              ///< bytes from row to row
  double depth_unit = 0.0;             ///< metres per step of a depth image
  std::uint64_t device_stamp = 0;      ///< microseconds of the device's own clock
  int index = 0;                       ///< counts frames; a gap is a dropped frame
};

/// Settings of the colour camera. An absent value is left alone (when set) or not known (when
/// read).
struct CameraSettings {
  std::optional<bool> auto_exposure;
  std::optional<bool> auto_white_balance;
  std::optional<int> exposure;  ///< in the device's own steps; acts with auto exposure off
  std::optional<int> gain;      ///< per cent for PrimeSense devices; acts with auto exposure off
};

bool operator==(const CameraSettings& a, const CameraSettings& b);
inline bool operator!=(const CameraSettings& a, const CameraSettings& b) {
  return !(a == b);
}

/// "auto exposure off, exposure 30"; for messages.
std::string toString(const CameraSettings& settings);

/// Names each value that was asked for and that the camera does not have; empty when it obeyed.
std::string disobeyed(const CameraSettings& asked, const CameraSettings& actual);

/// Which camera, and how it shall deliver.
struct DeviceRequest {
  /// Empty or "any"; "#1" for the first device; a serial number; an URI of OpenNI2; or the path of
  /// a recording (.oni).
  std::string address;
  int width = 640;            ///< pixels, of both images
  int height = 480;           ///< pixels
  int rate = 30;              ///< Hz
  double depth_unit = 0.001;  ///< metres: 0.001 or 0.0001
  bool registration = true;   ///< depth registered to colour by the device
  bool synchronise = true;    ///< colour and depth exposed together, where the device can
  bool repeat = false;        ///< a recording starts anew at its end
};

struct DeviceDescription {
  std::string uri;
  std::string name;    ///< vendor and product
  std::string serial;  ///< empty when the device has none
  bool is_recording = false;
  bool has_camera_settings = false;
  double color_field_of_view = 0.0;  ///< horizontal, rad; 0: not known
  double depth_field_of_view = 0.0;  ///< horizontal, rad; 0: not known
  /// What the device refused and can be lived without, one line each.
  std::vector<std::string> notes;
};

/// An open camera. Used by one thread; every call may wait for USB; failures are DeviceErrors.
class CameraDevice {
 public:
  virtual ~CameraDevice() = default;

  virtual const DeviceDescription& description() const = 0;

  /// Starting what runs and stopping what stands is allowed and does nothing.
  virtual void start(StreamKind kind) = 0;
  virtual void stop(StreamKind kind) = 0;

  /// False once the device was unplugged; never waits.
  virtual bool isConnected() const = 0;

  /// Hands the next image of the running streams to the callback. False: none came in this time.
  virtual bool read(std::chrono::milliseconds timeout,
                    const std::function<void(const ImageView&)>& callback) = 0;

  /// Sets what is given. Devices forget it unless the colour stream runs and has delivered.
  virtual void applySettings(const CameraSettings& settings) = 0;

  /// What the device says it has now.
  virtual CameraSettings settings() const = 0;
};

/// Opens a camera or throws DeviceError.
using DeviceFactory = std::function<std::unique_ptr<CameraDevice>(const DeviceRequest&)>;

}  // namespace mivo
