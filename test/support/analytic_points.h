// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/keyframe/reference_points.h"
#include "mivo/core/camera.h"
#include "support/analytic_image.h"
#include "support/point_derivatives.h"
#include "support/projection.h"

// Points of a keyframe whose image is known in closed form, and their intensities after an
// increment.

namespace mivo::testing {

inline Camera analyticCamera() {
  Camera camera;
  camera.width = 100;
  camera.height = 80;
  camera.fx = 90.0;
  camera.fy = 88.0;
  camera.cx = 49.0;
  camera.cy = 40.5;
  return camera;
}

/// A sloping, slightly waved surface, 1.2 to 2.2 m away.
inline double slopingDepth(int x, int y) {
  return 1.5 + 0.006 * x - 0.004 * y + 0.05 * std::sin(0.2 * x + 0.1 * y);
}

inline Eigen::Vector3d pointAt(const ReferencePoints& points, std::size_t i) {
  return {static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
          static_cast<double>(points.z[i])};
}

/// Where the increment d = (v, w) takes a point.
inline Eigen::Vector3d warped(const Eigen::Vector3d& point, const Vector6& d) {
  return expSo3(d.tail<3>()) * point + d.head<3>();
}

/// Points on a grid of pixels, every `step`, with the exact derivatives of the image (the curvature
/// of a lens left out, as in makeReferencePoints). The pinhole's derivatives are checked against
/// central differences by the tests themselves.
inline ReferencePoints analyticPoints(const AnalyticImage& image, const Camera& camera, int step) {
  ReferencePoints points;
  for (int y = 8; y < camera.height - 8; y += step) {
    for (int x = 8; x < camera.width - 8; x += step) points.pixels.push_back({x, y});
  }
  points.pixel_motion.setZero();
  for (const Pixel& pixel : points.pixels) {
    const Eigen::Vector3d ray = *camera.ray({pixel.x, pixel.y});
    const Eigen::Vector3d point = slopingDepth(pixel.x, pixel.y) * ray;
    Eigen::Matrix2d scale = Eigen::Matrix2d::Identity();
    camera.distort(ray.head<2>(), &scale);
    scale = Eigen::Vector2d(camera.fx, camera.fy).asDiagonal() * scale;
    const ImageJet jet = image({pixel.x, pixel.y});
    const PointDerivatives derivatives = pointDerivatives(point, scale.transpose() * jet.gradient,
                                                          scale.transpose() * jet.hessian * scale);
    points.x.push_back(static_cast<float>(point.x()));
    points.y.push_back(static_cast<float>(point.y()));
    points.z.push_back(static_cast<float>(point.z()));
    points.intensity.push_back(static_cast<float>(jet.value));
    points.contrast.push_back(1.0F);
    std::size_t entry = 0;
    for (int row = 0; row < 6; ++row) {
      points.jacobian[static_cast<std::size_t>(row)].push_back(
          static_cast<float>(derivatives.jacobian[row]));
      for (int column = row; column < 6; ++column) {
        points.second_derivative[entry++].push_back(
            static_cast<float>(derivatives.second(row, column)));
      }
    }
  }
  points.median_depth = 1.7F;
  return points;
}

/// The intensity of a point in the keyframe's image after an increment.
inline double warpedIntensity(const AnalyticImage& image, const Camera& camera,
                              const Eigen::Vector3d& point, const Vector6& d) {
  return image(*project(camera, warped(point, d))).value;
}

}  // namespace mivo::testing
