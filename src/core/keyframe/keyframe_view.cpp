// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/keyframe_view.h"

#include <optional>

#include "core/geometry/warp.h"

namespace mivo {
namespace {

constexpr int kStride = 2;  // pixels: a quarter of them is enough to look at

/// Points of the pixels, every second one, that have depth and a ray.
ReferencePoints pointsOf(const Keyframe& keyframe, const Camera& camera) {
  const LensRange range = camera.lensRange();
  const cv::Mat& depth = keyframe.depth();
  ReferencePoints points;
  for (int y = 0; y < depth.rows; y += kStride) {
    const auto* row = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; x += kStride) {
      if (!(row[x] > 0.0F)) continue;
      const std::optional<Eigen::Vector3d> ray = camera.ray({x, y}, range);
      if (!ray) continue;
      const Eigen::Vector3d point = static_cast<double>(row[x]) * *ray;
      points.pixels.push_back({x, y});
      points.x.push_back(static_cast<float>(point.x()));
      points.y.push_back(static_cast<float>(point.y()));
      points.z.push_back(static_cast<float>(point.z()));
      points.intensity.push_back(static_cast<float>(keyframe.image().at<unsigned char>(y, x)));
    }
  }
  return points;
}

}  // namespace

std::vector<CloudPoint> makeCloud(const Keyframe& keyframe, const Camera& camera) {
  const ReferencePoints points = pointsOf(keyframe, camera);
  std::vector<CloudPoint> cloud;
  cloud.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.push_back({points.x[i], points.y[i], points.z[i], points.intensity[i], points.pixels[i].x,
                     points.pixels[i].y});
  }
  return cloud;
}

cv::Mat makeResidualImage(const Keyframe& keyframe, const cv::Mat& live, const Camera& camera,
                          const Eigen::Isometry3d& T_live_ref) {
  const ReferencePoints points = pointsOf(keyframe, camera);
  LiveSamples samples;
  Warp(camera, RowMotion{}, 1).sample(points, points.size(), T_live_ref, live, samples);
  cv::Mat result((camera.height + 1) / kStride, (camera.width + 1) / kStride, CV_8UC1,
                 cv::Scalar(128));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (samples.visible[i] == 0.0F) continue;
    const Pixel& pixel = points.pixels[i];
    result.at<unsigned char>(pixel.y / kStride, pixel.x / kStride) =
        cv::saturate_cast<unsigned char>(128.0F + 0.5F * (samples.value[i] - points.intensity[i]));
  }
  return result;
}

}  // namespace mivo
