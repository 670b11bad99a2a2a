// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "synthetic/renderer.h"

namespace mivo {

/// A structured-light sensor as in Kinect and Xtion. It measures the disparity d = f b / z: noise
/// and steps are even in disparity and grow with z^2 in depth.
struct DepthSensorOptions {
  double focal_length = 575.0;    ///< f, pixels of the infrared camera
  double baseline = 0.075;        ///< b, m
  double noise = 0.06;            ///< standard deviation of the disparity, pixels; 0: none
  double disparity_step = 0.125;  ///< pixels; 0: not quantized
  bool holes = true;       ///< at edges, in the projector's shadow, at grazing angles, on black
  double min_depth = 0.4;  ///< m; nothing is read outside
  double max_depth = 5.0;  ///< m
  double units_per_meter = 5000.0;
};

class DepthSensor {
 public:
  /// Throws Error for a number out of range.
  DepthSensor(const DepthSensorOptions& options, const Camera& camera);

  const DepthSensorOptions& options() const { return options_; }

  /// Depth image as the sensor delivers it: CV_16UC1, in its units, 0 where there is no reading.
  cv::Mat sense(const SurfaceImage& surface, std::uint64_t seed) const;

  /// Standard deviation that noise and steps give a reading at depth z, m.
  double deviation(double z) const;

 private:
  float measured(float z, float normal_noise) const;
  void shadowRow(const float* depth, unsigned char* hole) const;
  static bool isEdge(const cv::Mat& depth, int x, int y);

  DepthSensorOptions options_;
  int width_;
  float color_focal_;
};

}  // namespace mivo
