// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/recorder.h"

#include <OpenNI.h>
#include <PS1080.h>

#include <cstdint>
#include <stdexcept>

namespace mivo {
namespace {

constexpr int kTimeout = 5000;  // ms

void check(openni::Status status, const char* what) {
  if (status != openni::STATUS_OK) {
    throw std::runtime_error(std::string(what) + ": " + openni::OpenNI::getExtendedError());
  }
}

class Library {
 public:
  Library() { check(openni::OpenNI::initialize(), "initialize"); }
  ~Library() { openni::OpenNI::shutdown(); }
};

void create(openni::VideoStream& stream, openni::Device& device, openni::SensorType sensor,
            openni::PixelFormat format) {
  check(stream.create(device, sensor), "create a stream");
  openni::VideoMode mode;
  mode.setResolution(640, 480);
  mode.setFps(30);
  mode.setPixelFormat(format);
  check(stream.setVideoMode(mode), "set the mode");
  check(stream.setMirroringEnabled(false), "set mirroring");
}

}  // namespace

void recordVirtualXtion(const std::string& path, int images,
                        const std::function<void()>& on_start) {
  Library library;
  openni::Device device;
  openni::VideoStream color;
  openni::VideoStream depth;
  openni::Recorder recorder;
  check(device.open("virtual_xtion://0"), "open the virtual camera");
  create(color, device, openni::SENSOR_COLOR, openni::PIXEL_FORMAT_RGB888);
  create(depth, device, openni::SENSOR_DEPTH, openni::PIXEL_FORMAT_DEPTH_1_MM);
  check(device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), "register");
  check(recorder.create(path.c_str()), "create the recording");
  check(recorder.attach(color), "attach color");
  check(recorder.attach(depth), "attach depth");
  check(recorder.start(), "start the recorder");
  check(color.start(), "start color");
  check(depth.start(), "start depth");
  check(device.setProperty<std::uint64_t>(XN_MODULE_PROPERTY_FIRMWARE_FRAME_SYNC, 1),
        "synchronize");
  on_start();
  openni::VideoStream* streams[] = {&color, &depth};
  for (int i = 0; i < images; ++i) {
    int ready = 0;
    check(openni::OpenNI::waitForAnyStream(streams, 2, &ready, kTimeout), "wait for an image");
    openni::VideoFrameRef frame;
    check(streams[ready]->readFrame(&frame), "read an image");
  }
  color.stop();
  depth.stop();
  recorder.stop();
  recorder.destroy();
  color.destroy();
  depth.destroy();
}

}  // namespace mivo
