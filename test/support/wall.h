// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core/mat.hpp>

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"
#include "support/random_pose.h"
#include "support/scene.h"

namespace mivo::testing {

/// Gray level of a wall at a place on it, meters to the right and down.
using Paint = std::function<double(double x, double y)>;

/// A wall two meters in front of a camera that faces it and moves parallel to it.
struct Wall {
  Paint paint;
  double distance = 2.0;       ///< m
  double gray_noise = 2.0;     ///< gray levels
  double depth_noise = 0.004;  ///< m

  Frame seenFrom(const Camera& camera, const Eigen::Vector2d& place, double stamp) const {
    Random random(static_cast<std::uint64_t>(std::lround(1e3 * stamp)));
    Frame frame;
    frame.stamp = stamp;
    frame.image.create(camera.height, camera.width, CV_8UC1);
    frame.depth.create(camera.height, camera.width, CV_32FC1);
    for (int v = 0; v < camera.height; ++v) {
      const double y = place.y() + distance * (v - camera.cy) / camera.fy;
      for (int u = 0; u < camera.width; ++u) {
        const double x = place.x() + distance * (u - camera.cx) / camera.fx;
        const double gray = paint(x, y) + gray_noise * random.normal();
        frame.image.at<unsigned char>(v, u) =
            static_cast<unsigned char>(std::lround(std::min(std::max(gray, 0.0), 255.0)));
        frame.depth.at<float>(v, u) = static_cast<float>(distance + depth_noise * random.normal());
      }
    }
    return frame;
  }
};

/// Waves of lengths that do not repeat within a view, in one direction.
inline double stripes(double s) {
  return 128.0 + 35.0 * std::sin(21.0 * s) + 25.0 * std::sin(8.3 * s + 1.0) +
         15.0 * std::sin(34.0 * s + 2.0);
}

/// Stripes along x: motion along them is not observable.
inline double horizontalStripes(double /*x*/, double y) {
  return stripes(y);
}

/// Texture in every direction.
inline double texture(double x, double y) {
  return 128.0 + 0.6 * (stripes(0.8 * x + 0.6 * y) - 128.0) +
         0.6 * (stripes(0.7 - 0.5 * x + 0.9 * y) - 128.0);
}

inline double blank(double /*x*/, double /*y*/) {
  return 128.0;
}

}  // namespace mivo::testing
