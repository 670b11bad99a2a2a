// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "openni2/device_error.h"
#include "openni2/openni2_device.h"
#include "virtual_xtion_fixture.h"

namespace mivo {

/// Opens devices through the real libOpenNI2, and keeps what they deliver.
class OpenNi2DeviceTest : public VirtualXtionTest {
 protected:
  struct Received {
    cv::Mat image;
    std::uint64_t stamp;
    int index;
    double depth_unit;
  };

  static DeviceRequest request(const std::string& address) {
    DeviceRequest request;
    request.address = address;
    return request;
  }

  static std::optional<DeviceError> faultOf(const DeviceRequest& request) {
    try {
      OpenNi2Device::open(request);
    } catch (const DeviceError& error) {
      return error;
    }
    return std::nullopt;
  }

  static void expectFault(const DeviceRequest& request, DeviceFault fault,
                          const std::string& part) {
    const auto error = faultOf(request);
    ASSERT_TRUE(error.has_value()) << "opened '" << request.address << "'";
    EXPECT_EQ(error->fault(), fault) << error->what();
    EXPECT_NE(std::string(error->what()).find(part), std::string::npos) << error->what();
    EXPECT_NE(std::string(error->what()).find(adviceFor(fault)), std::string::npos);
  }

  // Reads until both streams have given so many images.
  static std::map<StreamKind, std::vector<Received>> receive(CameraDevice& device,
                                                             std::size_t count) {
    std::map<StreamKind, std::vector<Received>> received;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while ((received[StreamKind::kColor].size() < count ||
            received[StreamKind::kDepth].size() < count) &&
           std::chrono::steady_clock::now() < end) {
      device.read(std::chrono::milliseconds(200), [&](const ImageView& view) {
        const int type = view.kind == StreamKind::kColor ? CV_8UC3 : CV_16UC1;
        const cv::Mat image(view.height, view.width, type, const_cast<std::uint8_t*>(view.data),
                            view.stride);
        received[view.kind].push_back(
            {image.clone(), view.device_stamp, view.index, view.depth_unit});
      });
    }
    return received;
  }

  /// Depth images that were taken with a color image.
  static int synchronousPairs(const std::map<StreamKind, std::vector<Received>>& received) {
    int pairs = 0;
    for (const Received& color : received.at(StreamKind::kColor)) {
      for (const Received& depth : received.at(StreamKind::kDepth)) {
        pairs += color.stamp == depth.stamp ? 1 : 0;
      }
    }
    return pairs;
  }

  static void startBoth(CameraDevice& device) {
    device.start(StreamKind::kColor);
    device.start(StreamKind::kDepth);
  }

  static bool same(const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
  }
};

}  // namespace mivo
