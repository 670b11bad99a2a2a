// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/depth_sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "mivo/core/error.h"
#include "synthetic/pixel_noise.h"

namespace mivo {
namespace {

constexpr float kEdgeRatio = 0.04F;      // depths that differ by more belong to two surfaces
constexpr float kEdgeHole = 0.5F;        // part of the pixels at an edge without a reading
constexpr float kGrazingAlways = 0.06F;  // cosine below which nothing comes back ...
constexpr float kGrazingNever = 0.16F;   // ... and above which all does
constexpr float kShadowMargin = 0.5F;    // pixels
constexpr int kNoiseCell = 3;  // pixels: matching windows make the noise of neighbors alike

// Normal noise that is alike within a few pixels: bilinear between random nodes, scaled back to
// unit variance everywhere.
float smoothNormal(std::uint64_t seed, int x, int y) {
  const int cx = x / kNoiseCell;
  const int cy = y / kNoiseCell;
  const float ax = (static_cast<float>(x % kNoiseCell) + 0.5F) / kNoiseCell;
  const float ay = (static_cast<float>(y % kNoiseCell) + 0.5F) / kNoiseCell;
  const auto node = [&](int column, int row) {
    return gaussianFrom(
        hashOf(seed, static_cast<std::uint64_t>(row), static_cast<std::uint64_t>(column)));
  };
  const float w00 = (1.0F - ax) * (1.0F - ay);
  const float w10 = ax * (1.0F - ay);
  const float w01 = (1.0F - ax) * ay;
  const float w11 = ax * ay;
  const float sum = w00 * node(cx, cy) + w10 * node(cx + 1, cy) + w01 * node(cx, cy + 1) +
                    w11 * node(cx + 1, cy + 1);
  return sum / std::sqrt(w00 * w00 + w10 * w10 + w01 * w01 + w11 * w11);
}

}  // namespace

DepthSensor::DepthSensor(const DepthSensorOptions& options, const Camera& camera)
    : options_(options), width_(camera.width), color_focal_(static_cast<float>(camera.fx)) {
  if (!(options.focal_length > 0.0) || !(options.baseline > 0.0) || !(options.noise >= 0.0) ||
      !(options.disparity_step >= 0.0) || !(options.min_depth >= 0.0) ||
      !(options.max_depth > options.min_depth) || !(options.units_per_meter > 0.0)) {
    throw Error(
        "depth sensor: focal length, baseline and units must be positive, noise and step not "
        "negative, the "
        "range in order");
  }
  if (options.max_depth * options.units_per_meter > 65535.0) {
    throw Error("depth sensor: the greatest depth does not fit into 16 bits with these units");
  }
}

float DepthSensor::measured(float z, float normal_noise) const {
  const double fb = options_.focal_length * options_.baseline;
  double disparity = fb / z + options_.noise * normal_noise;
  if (options_.disparity_step > 0.0) {
    disparity = options_.disparity_step * std::round(disparity / options_.disparity_step);
  }
  return disparity > 0.0 ? static_cast<float>(fb / disparity) : 0.0F;
}

double DepthSensor::deviation(double z) const {
  const double step_variance = options_.disparity_step * options_.disparity_step / 12.0;
  const double disparity_deviation = std::sqrt(options_.noise * options_.noise + step_variance);
  return z * z / (options_.focal_length * options_.baseline) * disparity_deviation;
}

// The projector stands to the right of the camera: it sees column u of depth z at u - f b / z.
// Coming from the right, a surface that does not appear left of all others so far is hidden from
// it.
void DepthSensor::shadowRow(const float* depth, unsigned char* hole) const {
  const float fb = color_focal_ * static_cast<float>(options_.baseline);
  float leftmost = std::numeric_limits<float>::infinity();
  for (int x = width_ - 1; x >= 0; --x) {
    if (depth[x] <= 0.0F) {
      continue;
    }
    const float seen_at = static_cast<float>(x) - fb / depth[x];
    if (seen_at > leftmost + kShadowMargin) {
      hole[x] = 1;
    }
    leftmost = std::min(leftmost, seen_at);
  }
}

bool DepthSensor::isEdge(const cv::Mat& depth, int x, int y) {
  const float z = depth.at<float>(y, x);
  const auto differs = [&](int nx, int ny) {
    if (nx < 0 || ny < 0 || nx >= depth.cols || ny >= depth.rows) {
      return false;
    }
    return std::abs(depth.at<float>(ny, nx) - z) > kEdgeRatio * z;
  };
  return differs(x - 1, y) || differs(x + 1, y) || differs(x, y - 1) || differs(x, y + 1);
}

cv::Mat DepthSensor::sense(const SurfaceImage& surface, std::uint64_t seed) const {
  cv::Mat image(surface.depth.size(), CV_16UC1);
  cv::parallel_for_(cv::Range(0, image.rows), [&](const cv::Range& range) {
    std::vector<unsigned char> hole(static_cast<std::size_t>(image.cols));
    for (int y = range.start; y < range.end; ++y) {
      const auto* depth = surface.depth.ptr<float>(y);
      const auto* cosine = surface.cosine.ptr<float>(y);
      auto* out = image.ptr<std::uint16_t>(y);
      std::fill(hole.begin(), hole.end(), static_cast<unsigned char>(0));
      if (options_.holes) {
        shadowRow(depth, hole.data());
      }
      for (int x = 0; x < image.cols; ++x) {
        out[x] = 0;
        float z = depth[x];
        if (z <= 0.0F) {
          continue;
        }
        if (options_.holes) {
          const std::uint64_t bits =
              hashOf(seed + 1, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x));
          const float kept = (cosine[x] - kGrazingAlways) / (kGrazingNever - kGrazingAlways);
          if (hole[static_cast<std::size_t>(x)] != 0 || uniformFrom(bits) >= kept ||
              (isEdge(surface.depth, x, y) && uniformFrom(mixBits(bits)) < kEdgeHole)) {
            continue;
          }
        }
        z = measured(z, options_.noise > 0.0 ? smoothNormal(seed, x, y) : 0.0F);
        if (z >= options_.min_depth && z <= options_.max_depth) {
          out[x] = static_cast<std::uint16_t>(std::lround(z * options_.units_per_meter));
        }
      }
    }
  });
  return image;
}

}  // namespace mivo
