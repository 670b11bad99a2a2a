// SPDX-License-Identifier: BSD-3-Clause
#include "session/depth_sample.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mivo {
namespace {

constexpr int kSampleStep = 8;  // pixels

double depthAt(const Frame& frame, int x, int y) {
  return frame.depth.type() == CV_16UC1 ? frame.depth.at<std::uint16_t>(y, x) * frame.depth_unit
                                        : static_cast<double>(frame.depth.at<float>(y, x));
}

}  // namespace

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
