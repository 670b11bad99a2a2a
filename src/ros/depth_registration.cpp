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

/// Where a point of the colour camera's frame falls, in pixels; nothing behind it or outside of its
/// lens.
struct Projection {
  Projection(const Camera& camera) : camera(camera), range(camera.lensRange()) {}
  bool operator()(const Eigen::Vector3f& point, Eigen::Vector2f& pixel) const {
    if (!(point.z() > 0.0F)) return false;
    Eigen::Vector2d normalised = (point.head<2>() / point.z()).cast<double>();
    if (!camera.distortion.isZero()) {
      if (normalised.norm() > range.undistorted) return false;
      normalised = camera.distort(normalised);
    }
    pixel = Eigen::Vector2d(camera.fx * normalised.x() + camera.cx,
                            camera.fy * normalised.y() + camera.cy)
                .cast<float>();
    return true;
  }
  const Camera& camera;
  LensRange range;
};

/// Sets the pixels of a square to the depth where nothing nearer is.
void paint(const Eigen::Vector2f& centre, float half_width, float half_height, float metres,
           cv::Mat& image) {
  const int left = std::max(0, static_cast<int>(std::ceil(centre.x() - half_width)));
  const int top = std::max(0, static_cast<int>(std::ceil(centre.y() - half_height)));
  const int right = std::min(image.cols - 1, static_cast<int>(std::floor(centre.x() + half_width)));
  const int bottom =
      std::min(image.rows - 1, static_cast<int>(std::floor(centre.y() + half_height)));
  for (int y = top; y <= bottom; ++y) {
    auto* row = image.ptr<float>(y);
    for (int x = left; x <= right; ++x) {
      if (!(row[x] <= metres)) row[x] = metres;  // also where there is none yet
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

DepthImage DepthRegistration::toColour(const DepthImage& depth, const Camera& depth_camera,
                                       const Camera& colour_camera,
                                       const Eigen::Isometry3d& T_colour_depth) {
  if (depth.image.cols != depth_camera.width || depth.image.rows != depth_camera.height) {
    throw Error("the depth has " + std::to_string(depth.image.cols) + " x " +
                std::to_string(depth.image.rows) + " pixels, but its camera_info is for " +
                std::to_string(depth_camera.width) + " x " + std::to_string(depth_camera.height));
  }
  findRays(depth_camera);
  const Projection project(colour_camera);
  const Eigen::Isometry3f T = T_colour_depth.cast<float>();
  // Half the side of a reading's square, in pixels of colour per ratio of depths.
  const auto half_width = static_cast<float>(0.5 * colour_camera.fx / depth_camera.fx) * kOverlap;
  const auto half_height = static_cast<float>(0.5 * colour_camera.fy / depth_camera.fy) * kOverlap;
  DepthImage seen;
  seen.image = cv::Mat(colour_camera.height, colour_camera.width, CV_32FC1, cv::Scalar(kNoReading));
  auto ray = rays_.begin();
  for (int y = 0; y < depth.image.rows; ++y) {
    for (int x = 0; x < depth.image.cols; ++x, ++ray) {
      const float metres = depthInMetres(depth.image, depth.unit, x, y);
      if (std::isnan(metres) || ray->z() == 0.0F) continue;
      const Eigen::Vector3f point = T * (metres * *ray);
      Eigen::Vector2f pixel;
      if (!project(point, pixel)) continue;
      const float ratio = metres / point.z();
      paint(pixel, std::max(0.5F, half_width * ratio), std::max(0.5F, half_height * ratio),
            point.z(), seen.image);
    }
  }
  return seen;
}

}  // namespace mivo
