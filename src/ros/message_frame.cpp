// SPDX-License-Identifier: BSD-3-Clause
#include "ros/message_frame.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mivo/core/error.h"
#include "ros/camera_conversion.h"
#include "ros/stamp.h"

namespace mivo {
namespace {

constexpr int kSampleStep = 8;  // pixels

double depthAt(const Frame& frame, int x, int y) {
  return frame.depth.type() == CV_16UC1 ? frame.depth.at<std::uint16_t>(y, x) * frame.depth_unit
                                        : static_cast<double>(frame.depth.at<float>(y, x));
}

}  // namespace

MessageFrame toFrame(const ImagePair& pair, bool rectified) {
  MessageFrame result;
  result.camera = toCamera(*pair.camera_info, rectified);
  result.frame.stamp = toSeconds(pair.colour->header.stamp);
  const ColourImage colour = pair.colour->toColourImage();
  result.frame.image = toGrey(colour.image, colour.order);
  const DepthImage depth = pair.depth->toDepthImage();
  result.frame.depth = depth.image;
  result.frame.depth_unit = depth.unit;
  const std::string fault = findFault(result.frame, result.camera);
  if (!fault.empty()) throw Error(fault);
  return result;
}

DepthSample sampleDepth(const Frame& frame) {
  std::vector<double> readings;
  int pixels = 0;
  for (int y = 0; y < frame.depth.rows; y += kSampleStep) {
    for (int x = 0; x < frame.depth.cols; x += kSampleStep) {
      ++pixels;
      const double depth = depthAt(frame, x, y);
      if (std::isfinite(depth) && depth > 0.0) readings.push_back(depth);
    }
  }
  DepthSample sample;
  if (readings.empty()) return sample;
  sample.coverage = static_cast<double>(readings.size()) / pixels;
  const auto middle = readings.begin() + static_cast<std::ptrdiff_t>(readings.size() / 2);
  std::nth_element(readings.begin(), middle, readings.end());
  sample.median = *middle;
  return sample;
}

}  // namespace mivo
