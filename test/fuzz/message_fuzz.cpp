// SPDX-License-Identifier: BSD-3-Clause
// Raw images and calibrations whose fields need not agree with each other.
#include <fuzzer/FuzzedDataProvider.h>

#include "fuzz/fuzz_file.h"
#include "ros/camera_conversion.h"
#include "ros/image_conversion.h"

namespace {

constexpr const char* kEncodings[] = {
    "mono8",       "mono16",      "rgb8",         "bgr8",        "rgba8", "bgra8",
    "rgb16",       "bgr16",       "8UC1",         "8UC3",        "8UC4",  "16UC1",
    "32FC1",       "yuv422",      "yuyv",         "yuv422_yuy2", "nv12",  "nv21",
    "bayer_rggb8", "bayer_gbrg8", "bayer_bggr16", "64FC1",       ""};
constexpr const char* kModels[] = {"plumb_bob", "rational_polynomial", "equidistant",
                                   "fisheye",   "thin_prism",          ""};
constexpr std::uint32_t kMostPixels = 4096;  // of a side; more is tried by a few bits more

std::uint32_t size(FuzzedDataProvider& input) {
  return input.ConsumeIntegralInRange<int>(0, 15) == 0
             ? input.ConsumeIntegral<std::uint32_t>()
             : input.ConsumeIntegralInRange<std::uint32_t>(0, kMostPixels);
}

double number(FuzzedDataProvider& input) {
  return input.ConsumeBool() ? input.ConsumeFloatingPoint<double>()
                             : input.ConsumeFloatingPointInRange<double>(-1000.0, 1000.0);
}

void tryCamera(FuzzedDataProvider& input) {
  sensor_msgs::CameraInfo info;
  info.width = size(input);
  info.height = size(input);
  info.distortion_model = input.PickValueInArray(kModels);
  for (double& k : info.K) k = number(input);
  for (double& p : info.P) p = number(input);
  info.D.resize(input.ConsumeIntegralInRange<std::size_t>(0, 14));
  for (double& d : info.D) d = number(input);
  info.binning_x = input.ConsumeIntegral<std::uint8_t>();
  info.binning_y = input.ConsumeIntegral<std::uint8_t>();
  info.roi.x_offset = size(input);
  info.roi.y_offset = size(input);
  info.roi.width = size(input);
  info.roi.height = size(input);
  const cv::Size image(input.ConsumeIntegralInRange<int>(0, 700),
                       input.ConsumeIntegralInRange<int>(0, 500));
  const bool rectified = input.ConsumeBool();
  mivo::expectErrorOrSuccess([&] { mivo::toCamera(info, rectified, image).validate(); });
}

void tryImage(FuzzedDataProvider& input) {
  sensor_msgs::Image image;
  image.encoding = input.PickValueInArray(kEncodings);
  image.width = size(input);
  image.height = size(input);
  image.step = size(input);
  image.is_bigendian = input.ConsumeIntegral<std::uint8_t>();
  image.data = input.ConsumeRemainingBytes<std::uint8_t>();
  mivo::expectErrorOrSuccess([&] { mivo::toColorImage(image); });
  mivo::expectErrorOrSuccess([&] { mivo::toGrayImage(image); });
  mivo::expectErrorOrSuccess([&] { mivo::toDepthImage(image); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  FuzzedDataProvider input(bytes, count);
  if (input.ConsumeBool()) {
    tryCamera(input);
  } else {
    tryImage(input);
  }
  return 0;
}
