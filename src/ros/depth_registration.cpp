// SPDX-License-Identifier: BSD-3-Clause
#include "ros/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
// Readings further apart than this share of their depth are of different surfaces.
constexpr float kSameSurface = 0.05F;
// Of a pixel's half side: pixels that touch leave no seams between them.
constexpr float kOverlap = 1.05F;

/// Metres; NaN for no reading.
float metresAt(const DepthImage& depth, int x, int y) {
  const float metres =
      depth.image.type() == CV_16UC1
          ? static_cast<float>(depth.image.at<std::uint16_t>(y, x)) * static_cast<float>(depth.unit)
          : depth.image.at<float>(y, x);
  return metres > 0.0F && std::isfinite(metres) ? metres : kNoReading;
}

/// Between readings. The inverse depth of a plane is linear in the pixel.
float interpolated(const DepthImage& depth, float x, float y) {
  const int columns = depth.image.cols;
  const int rows = depth.image.rows;
  const int left = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(0, columns - 2));
  const int top = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(0, rows - 2));
  const int nearest_x = std::clamp(static_cast<int>(std::lround(x)), 0, columns - 1);
  const int nearest_y = std::clamp(static_cast<int>(std::lround(y)), 0, rows - 1);
  const float nearest = metresAt(depth, nearest_x, nearest_y);
  if (columns < 2 || rows < 2 || std::isnan(nearest)) return nearest;
  const float corners[4] = {metresAt(depth, left, top), metresAt(depth, left + 1, top),
                            metresAt(depth, left, top + 1), metresAt(depth, left + 1, top + 1)};
  for (const float corner : corners) {
    if (!(std::abs(corner - nearest) <= kSameSurface * nearest)) return nearest;
  }
  const float u = x - static_cast<float>(left);
  const float v = y - static_cast<float>(top);
  const float upper = (1.0F - u) / corners[0] + u / corners[1];
  const float lower = (1.0F - u) / corners[2] + u / corners[3];
  return 1.0F / ((1.0F - v) * upper + v * lower);
}

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
  const cv::Size small = depth.image.size();
  if (small == size || small.width <= 0 || small.height <= 0) return depth;
  const int factor = size.width / small.width;
  if (factor < 2 || factor * small.width != size.width || factor * small.height != size.height) {
    return depth;
  }
  DepthImage large;
  large.image.create(size, CV_32FC1);
  const float scale = 1.0F / static_cast<float>(factor);
  for (int y = 0; y < size.height; ++y) {
    auto* row = large.image.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      row[x] = interpolated(depth, (static_cast<float>(x) + 0.5F) * scale - 0.5F,
                            (static_cast<float>(y) + 0.5F) * scale - 0.5F);
    }
  }
  return large;
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
      const float metres = metresAt(depth, x, y);
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
