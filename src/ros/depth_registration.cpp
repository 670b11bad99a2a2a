// SPDX-License-Identifier: BSD-3-Clause
#include "ros/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mivo/core/error.h"
#include "session/depth_enlargement.h"

namespace mivo {
namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
// Of a pixel's half side: pixels that touch leave no seams between them.
constexpr float kOverlap = 1.05F;

/// Where a point of the color camera's frame falls, in pixels; nothing behind it or outside of its
/// lens.
struct Projection {
  Projection(const Camera& camera) : camera(camera), range(camera.lensRange()) {}
  bool operator()(const Eigen::Vector3f& point, Eigen::Vector2f& pixel) const {
    if (!(point.z() > 0.0F)) return false;
    Eigen::Vector2d normalized = (point.head<2>() / point.z()).cast<double>();
    if (!camera.distortion.isZero()) {
      if (normalized.norm() > range.undistorted) return false;
      normalized = camera.distort(normalized);
    }
    pixel = Eigen::Vector2d(camera.fx * normalized.x() + camera.cx,
                            camera.fy * normalized.y() + camera.cy)
                .cast<float>();
    return true;
  }
  const Camera& camera;
  LensRange range;
};

/// Sets the pixels of a square to the depth where nothing nearer is.
void paint(const Eigen::Vector2f& center, float half_width, float half_height, float meters,
           cv::Mat& image) {
  const int left = std::max(0, static_cast<int>(std::ceil(center.x() - half_width)));
  const int top = std::max(0, static_cast<int>(std::ceil(center.y() - half_height)));
  const int right = std::min(image.cols - 1, static_cast<int>(std::floor(center.x() + half_width)));
  const int bottom =
      std::min(image.rows - 1, static_cast<int>(std::floor(center.y() + half_height)));
  for (int y = top; y <= bottom; ++y) {
    auto* row = image.ptr<float>(y);
    for (int x = left; x <= right; ++x) {
      if (!(row[x] <= meters)) row[x] = meters;  // also where there is none yet
    }
  }
}

}  // namespace

DepthImage enlargeDepth(const DepthImage& depth, const cv::Size& size) {
  if (!isWholeMultiple(size, depth.image.size())) return depth;
  return {enlargeDepth(depth.image, depth.unit, size), depth.unit};
}

void DepthRegistration::findRays(const Camera& depth_camera) {
  if (!rays_.empty() && camera_ == depth_camera) return;
  camera_ = depth_camera;
  rays_.clear();
  const LensRange range = camera_.lensRange();
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const std::optional<Eigen::Vector3d> ray = camera_.ray({x, y}, range);
      rays_.push_back(ray ? Eigen::Vector3f(ray->cast<float>()) : Eigen::Vector3f::Zero());
    }
  }
}

DepthImage DepthRegistration::toColor(const DepthImage& depth, const Camera& depth_camera,
                                      const Camera& color_camera,
                                      const Eigen::Isometry3d& T_color_depth) {
  if (depth.image.cols != depth_camera.width || depth.image.rows != depth_camera.height) {
    throw Error("the depth has " + std::to_string(depth.image.cols) + " x " +
                std::to_string(depth.image.rows) + " pixels, but its camera_info is for " +
                std::to_string(depth_camera.width) + " x " + std::to_string(depth_camera.height));
  }
  findRays(depth_camera);
  const Projection project(color_camera);
  const Eigen::Isometry3f T = T_color_depth.cast<float>();
  // Half the side of a reading's square, in pixels of color per ratio of depths.
  const auto half_width = static_cast<float>(0.5 * color_camera.fx / depth_camera.fx) * kOverlap;
  const auto half_height = static_cast<float>(0.5 * color_camera.fy / depth_camera.fy) * kOverlap;
  DepthImage seen;
  seen.image = cv::Mat(color_camera.height, color_camera.width, CV_32FC1, cv::Scalar(kNoReading));
  auto ray = rays_.begin();
  for (int y = 0; y < depth.image.rows; ++y) {
    for (int x = 0; x < depth.image.cols; ++x, ++ray) {
      const float meters = depthInMeters(depth.image, depth.unit, x, y);
      if (std::isnan(meters) || ray->z() == 0.0F) continue;
      const Eigen::Vector3f point = T * (meters * *ray);
      Eigen::Vector2f pixel;
      if (!project(point, pixel)) continue;
      const float ratio = meters / point.z();
      paint(pixel, std::max(0.5F, half_width * ratio), std::max(0.5F, half_height * ratio),
            point.z(), seen.image);
    }
  }
  return seen;
}

}  // namespace mivo
