// SPDX-License-Identifier: BSD-3-Clause
#include "session/depth_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "session/median.h"

namespace mivo {
namespace {

constexpr int kSampleStep = 8;  // pixels
// readings >= this: enough to say how they are stored.
constexpr std::size_t kEnoughReadings = 200;
// Two depths of one surface differ by far less than this share of them from pixel to pixel, values
// whose low bits stand for kilometers by more.
constexpr double kJump = 0.1;
// jumps > this share of the neighbors: surfaces have them at edges only.
constexpr double kManyJumps = 0.2;
// step / median > this: no sensor, at a distance at which it works, is so coarse; a Kinect at 8 m
// comes to 0.02, 8 bits over 8 m to 0.02 at 1.5 m.
constexpr double kCoarse = 0.03;
// readings that differ >= this: fewer are flat surfaces, seen straight.
constexpr std::size_t kDifferentReadings = 4;

double depthAt(const Frame& frame, int x, int y) {
  return frame.depth.type() == CV_16UC1 ? frame.depth.at<std::uint16_t>(y, x) * frame.depth_unit
                                        : static_cast<double>(frame.depth.at<float>(y, x));
}

std::uint16_t rotatedLeft(std::uint16_t value) {
  return static_cast<std::uint16_t>(value << 3 | value >> 13);
}

/// Two pixels beside each other, with readings.
struct Neighbors {
  std::uint16_t left;
  std::uint16_t right;
};

std::vector<Neighbors> neighborsOf(const cv::Mat& depth) {
  std::vector<Neighbors> pairs;
  for (int y = 0; y < depth.rows; y += kSampleStep) {
    const auto* const row = depth.ptr<std::uint16_t>(y);
    for (int x = 0; x + 1 < depth.cols; x += kSampleStep) {
      if (row[x] != 0 && row[x + 1] != 0) pairs.push_back({row[x], row[x + 1]});
    }
  }
  return pairs;
}

/// Part of the neighbors that differ by more than kJump of the smaller.
template <typename Decode>
double partOfJumps(const std::vector<Neighbors>& pairs, const Decode& decode) {
  const auto jumps = [&](const Neighbors& pair) {
    const int a = decode(pair.left);
    const int b = decode(pair.right);
    return std::abs(a - b) > kJump * std::min(a, b);
  };
  return static_cast<double>(std::count_if(pairs.begin(), pairs.end(), jumps)) /
         static_cast<double>(pairs.size());
}

/// The least difference of two readings when it is coarse, otherwise 0; in depth units.
double coarseStep(const std::vector<Neighbors>& pairs) {
  std::vector<double> values;
  for (const Neighbors& pair : pairs) values.push_back(pair.left);
  const double median = medianOf(values);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < kDifferentReadings) return 0.0;
  double step = values.back();
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  return step > kCoarse * median ? step : 0.0;
}

}  // namespace

DepthStorage examineDepthStorage(const Frame& frame) {
  DepthStorage storage;
  if (frame.depth.type() != CV_16UC1) return storage;
  const std::vector<Neighbors> pairs = neighborsOf(frame.depth);
  if (pairs.size() < kEnoughReadings) return storage;
  storage.is_multiple_of_8 = std::all_of(pairs.begin(), pairs.end(), [](const Neighbors& pair) {
    return (pair.left | pair.right) % 8 == 0;
  });
  const double jumps = partOfJumps(pairs, [](std::uint16_t value) { return value; });
  storage.is_rotated_right = jumps > kManyJumps && partOfJumps(pairs, rotatedLeft) < 0.5 * jumps;
  storage.coarse_step = storage.is_rotated_right ? 0.0 : coarseStep(pairs) * frame.depth_unit;
  return storage;
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
  sample.median = medianOf(std::move(readings));
  return sample;
}

}  // namespace mivo
