// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/openni2_device.h"

#include <OpenNI.h>

#include <array>
#include <atomic>
#include <list>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>

#include "openni2/device_address.h"
#include "openni2/device_error.h"
#include "openni2/frame_sync.h"
#include "openni2/openni2_library.h"
#include "openni2/video_mode.h"

namespace mivo {
namespace {

constexpr std::array<StreamKind, kStreamKinds> kKinds{StreamKind::kColor, StreamKind::kDepth};

// Of the device without hardware that the SDK brings along.
const std::string kDummyUri = "Dummy";

// What belongs to the SDK.
struct Handles {
  std::shared_ptr<OpenNi2Library> library = OpenNi2Library::acquire();  // first: goes last
  openni::Device device;
  std::array<openni::VideoStream, kStreamKinds> streams;
};

/// The threads of the Dummy's streams do not end with stop() but a frame later, and nobody waits
/// for them: stream and driver must never go away, not at the end of the process either, or they
/// run in memory that is gone.
void keepForever(std::unique_ptr<Handles> handles) {
  static auto& kept = *new std::list<std::unique_ptr<Handles>>;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  kept.push_back(std::move(handles));
}

openni::SensorType sensorOf(StreamKind kind) {
  return kind == StreamKind::kColor ? openni::SENSOR_COLOR : openni::SENSOR_DEPTH;
}

template <typename Value>
std::optional<Value> readProperty(const openni::VideoStream& stream, int property) {
  Value value{};
  if (stream.getProperty<Value>(property, &value) != openni::STATUS_OK) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

class OpenNi2Device::Implementation : private openni::OpenNI::DeviceDisconnectedListener {
 public:
  explicit Implementation(const DeviceRequest& request) {
    openAddress(*handles_->library, request.address, handles_->device);
    describe();
    // From here on the destructor does not run when something throws: members clean up themselves.
    createStreams(request);
    setRegistration(request);
    setSynchronization(request);
    setPlayback(request);
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }

  ~Implementation() override {
    openni::OpenNI::removeDeviceDisconnectedListener(this);
    for (openni::VideoStream& stream : handles_->streams) {
      stream.stop();
    }
    if (description_.uri == kDummyUri && has_streamed_) {
      keepForever(std::move(handles_));
    }
  }

  const DeviceDescription& description() const { return description_; }
  bool isConnected() const { return connected_; }

  void start(StreamKind kind) {
    bool& running = running_[static_cast<std::size_t>(kind)];
    if (running) {
      return;
    }
    if (stream(kind).start() != openni::STATUS_OK) {
      throw DeviceError(DeviceFault::kUsb, description_.name + " does not start its " +
                                               mivo::toString(kind) + " stream: " + sdkError());
    }
    running = true;
    has_streamed_ = true;
    if (can_synchronize_ && running_[0] && running_[1]) {
      synchronize(handles_->device, true);
    }
  }

  void stop(StreamKind kind) {
    bool& running = running_[static_cast<std::size_t>(kind)];
    if (running) {
      if (can_synchronize_) {
        synchronize(handles_->device, false);  // or the other stream waits for this one
      }
      stream(kind).stop();
      running = false;
    }
  }

  bool read(std::chrono::milliseconds timeout,
            const std::function<void(const ImageView&)>& callback) {
    std::array<openni::VideoStream*, kStreamKinds> running{};
    int count = 0;
    for (StreamKind kind : kKinds) {
      if (running_[static_cast<std::size_t>(kind)]) {
        running[static_cast<std::size_t>(count++)] = &stream(kind);
      }
    }
    int ready = -1;
    const openni::Status status = openni::OpenNI::waitForAnyStream(
        running.data(), count, &ready, static_cast<int>(timeout.count()));
    if (status == openni::STATUS_TIME_OUT) {
      return false;
    }
    openni::VideoFrameRef frame;
    if (status != openni::STATUS_OK || ready < 0 ||
        running[static_cast<std::size_t>(ready)]->readFrame(&frame) != openni::STATUS_OK) {
      throw DeviceError(DeviceFault::kLost, description_.name + " cannot be read: " + sdkError());
    }
    callback(viewOf(frame));
    return true;
  }

  void applySettings(const CameraSettings& settings) {
    // Auto exposure first: while it is on, exposure and gain are the camera's own.
    setProperty(openni::STREAM_PROPERTY_AUTO_EXPOSURE, settings.auto_exposure);
    setProperty(openni::STREAM_PROPERTY_AUTO_WHITE_BALANCE, settings.auto_white_balance);
    if (!settings.auto_exposure.value_or(false)) {
      setProperty(openni::STREAM_PROPERTY_EXPOSURE, settings.exposure);
      setProperty(openni::STREAM_PROPERTY_GAIN, settings.gain);
    }
  }

  CameraSettings settings() {
    const openni::VideoStream& color = stream(StreamKind::kColor);
    CameraSettings settings;
    if (const auto on = readProperty<OniBool>(color, openni::STREAM_PROPERTY_AUTO_EXPOSURE)) {
      settings.auto_exposure = *on != 0;
    }
    if (const auto on = readProperty<OniBool>(color, openni::STREAM_PROPERTY_AUTO_WHITE_BALANCE)) {
      settings.auto_white_balance = *on != 0;
    }
    settings.exposure = readProperty<int>(color, openni::STREAM_PROPERTY_EXPOSURE);
    settings.gain = readProperty<int>(color, openni::STREAM_PROPERTY_GAIN);
    return settings;
  }

 private:
  openni::VideoStream& stream(StreamKind kind) {
    return handles_->streams[static_cast<std::size_t>(kind)];
  }

  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    if (description_.uri == info->getUri()) {
      connected_ = false;
    }
  }

  void describe() {
    const openni::DeviceInfo& info = handles_->device.getDeviceInfo();
    description_.uri = info.getUri();
    description_.is_recording = handles_->device.isFile();
    description_.name = description_.is_recording
                            ? "Recording"
                            : oneLine(std::string(info.getVendor()) + " " + info.getName());
    description_.serial = serialNumber(handles_->device);
  }

  void createStreams(const DeviceRequest& request) {
    for (StreamKind kind : kKinds) {
      const bool is_color = kind == StreamKind::kColor;
      if (!handles_->device.hasSensor(sensorOf(kind))) {
        throw DeviceError(is_color ? DeviceFault::kNoColor : DeviceFault::kNoDepth,
                          description_.name + " has no " + mivo::toString(kind) + " stream");
      }
      openni::VideoStream& stream = this->stream(kind);
      if (stream.create(handles_->device, sensorOf(kind)) != openni::STATUS_OK) {
        throw DeviceError(DeviceFault::kUsb, description_.name + " does not open its " +
                                                 mivo::toString(kind) + " stream: " + sdkError());
      }
      setVideoMode(stream, kind, request, description_);
      stream.setMirroringEnabled(false);
      if (stream.getMirroringEnabled()) {
        note(std::string("The ") + mivo::toString(kind) + " image of " + description_.name +
             " is mirrored and mirroring cannot be disabled: do not use it for odometry");
      }
    }
    openni::VideoStream& color = stream(StreamKind::kColor);
    description_.color_field_of_view = color.getHorizontalFieldOfView();
    description_.depth_field_of_view = stream(StreamKind::kDepth).getHorizontalFieldOfView();
    description_.has_camera_settings = color.getCameraSettings() != nullptr;
    if (!description_.has_camera_settings && !description_.is_recording) {
      note(description_.name + " has no settings for exposure and white balance");
    }
  }

  void setRegistration(const DeviceRequest& request) {
    const auto mode = request.registration ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR
                                           : openni::IMAGE_REGISTRATION_OFF;
    if (handles_->device.getImageRegistrationMode() == mode && request.registration) {
      return;
    }
    if (description_.is_recording) {
      // A recording keeps its pixels; whether they were registered is not always written into it.
      if (request.registration) {
        note(
            "The recording does not say that its depth is registered to color; assuming that it "
            "is");
      }
      return;
    }
    if (request.registration &&
        (!handles_->device.isImageRegistrationModeSupported(mode) ||
         handles_->device.setImageRegistrationMode(mode) != openni::STATUS_OK ||
         handles_->device.getImageRegistrationMode() != mode)) {
      throw DeviceError(DeviceFault::kNoRegistration,
                        description_.name + " cannot register depth to color");
    }
    if (!request.registration && handles_->device.isImageRegistrationModeSupported(mode)) {
      handles_->device.setImageRegistrationMode(mode);
    }
  }

  void setSynchronization(const DeviceRequest& request) {
    can_synchronize_ = request.synchronize && canSynchronize(handles_->device);
    if (request.synchronize && !can_synchronize_ && !description_.is_recording) {
      note(description_.name +
           " does not expose color and depth together; they are paired by time alone");
    }
  }

  void setPlayback(const DeviceRequest& request) {
    if (openni::PlaybackControl* playback = handles_->device.getPlaybackControl()) {
      playback->setSpeed(1.0F);
      playback->setRepeatEnabled(request.repeat);
    }
  }

  template <typename Value>
  void setProperty(int property, const std::optional<Value>& value) {
    if (!value) {
      return;
    }
    // A refusal shows when the settings are read back.
    if constexpr (std::is_same_v<Value, bool>) {
      stream(StreamKind::kColor).setProperty<OniBool>(property, *value ? 1 : 0);
    } else {
      stream(StreamKind::kColor).setProperty<Value>(property, *value);
    }
  }

  void note(const std::string& line) { description_.notes.push_back(line); }

  std::unique_ptr<Handles> handles_ = std::make_unique<Handles>();
  std::array<bool, kStreamKinds> running_{};
  bool has_streamed_ = false;
  bool can_synchronize_ = false;
  std::atomic<bool> connected_{true};
  DeviceDescription description_;
};

OpenNi2Device::OpenNi2Device(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}

OpenNi2Device::~OpenNi2Device() = default;

std::unique_ptr<CameraDevice> OpenNi2Device::open(const DeviceRequest& request) {
  return std::unique_ptr<CameraDevice>(
      new OpenNi2Device(std::make_unique<Implementation>(request)));
}

const DeviceDescription& OpenNi2Device::description() const {
  return implementation_->description();
}

void OpenNi2Device::start(StreamKind kind) {
  implementation_->start(kind);
}
void OpenNi2Device::stop(StreamKind kind) {
  implementation_->stop(kind);
}
bool OpenNi2Device::isConnected() const {
  return implementation_->isConnected();
}

bool OpenNi2Device::read(std::chrono::milliseconds timeout,
                         const std::function<void(const ImageView&)>& callback) {
  return implementation_->read(timeout, callback);
}

void OpenNi2Device::applySettings(const CameraSettings& settings) {
  implementation_->applySettings(settings);
}

CameraSettings OpenNi2Device::settings() const {
  return implementation_->settings();
}

}  // namespace mivo
