// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/depth_agreement.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/images/depth_pyramid.h"

namespace mivo {
namespace {

// The patches of the keyframe's planes are as large: 14 pixels of the image at 640 columns.
constexpr int kReadings = 2;    // to each side
constexpr int kFewest = 13;     // count >= this: half of the 25
constexpr int kStepPixels = 3;  // between two of them

/// The rays around a pixel: a lens is straight enough over the few pixels of a plane.
struct LocalRays {
  Eigen::Vector2d middle;     // normalized coordinates
  Eigen::Matrix2d per_pixel;  // derivative with respect to the pixel
};

/// Nothing where the pixel has no ray.
std::optional<LocalRays> raysAround(const Camera& camera, const LensRange& range, int u, int v) {
  const auto ray = camera.ray({u, v}, range);
  if (!ray) return std::nullopt;
  const Eigen::Vector2d pixel(1.0 / camera.fx, 1.0 / camera.fy);
  LocalRays rays{ray->head<2>(), pixel.asDiagonal()};
  if (camera.distortion.isZero()) return rays;
  Eigen::Matrix2d behind_lens;
  camera.distort(rays.middle, &behind_lens);
  rays.per_pixel = behind_lens.inverse() * rays.per_pixel;
  return rays;
}

/// Normal of a plane through the live depth around a pixel, in the axes of the live camera, towards
/// it. Nothing where readings are missing.
std::optional<Eigen::Vector3d> liveNormal(const kernels::DepthView& readings, const Camera& camera,
                                          const LocalRays& rays, int u, int v) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (int row = -kReadings; row <= kReadings; ++row) {
    for (int column = -kReadings; column <= kReadings; ++column) {
      const int x = u + kStepPixels * column;
      const int y = v + kStepPixels * row;
      if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
      const auto depth = static_cast<double>(depthAt(readings, x, y));
      if (!(depth > 0.0)) continue;
      // Inverse depth is linear in the ray on a plane, whatever its distance.
      const Eigen::Vector3d place =
          (rays.middle + rays.per_pixel * Eigen::Vector2d(x - u, y - v)).homogeneous();
      moments += place * place.transpose();
      sum += place / depth;
      ++count;
    }
  }
  if (count < kFewest) return std::nullopt;
  const Eigen::Vector3d plane = moments.ldlt().solve(sum);  // plane . place = 1 / depth
  const double length = plane.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return -plane / length;
}

}  // namespace

Agreement depthAgreement(const GeometricPoints& points, const Frame& live, const Camera& camera,
                         const std::vector<float>& u, const std::vector<float>& v,
                         const std::vector<float>& visible, const Eigen::Isometry3d& T_live_ref,
                         std::size_t most_points) {
  Agreement agreement;
  const LensRange range = camera.lensRange();
  const std::size_t stride =
      std::max<std::size_t>(1, visible.size() / std::max<std::size_t>(1, most_points));
  for (std::size_t i = 0; i < visible.size(); i += stride) {
    if (visible[i] == 0.0F) continue;
    const auto column = static_cast<int>(std::lround(u[i]));
    const auto row = static_cast<int>(std::lround(v[i]));
    const auto rays = raysAround(camera, range, column, row);
    if (!rays) continue;
    const auto normal = liveNormal(depthView(live), camera, *rays, column, row);
    if (!normal) continue;
    const Eigen::Vector3d point =
        Eigen::Vector3f(points.x[i], points.y[i], points.z[i]).cast<double>();
    const Eigen::Vector3d by_keyframe =
        Eigen::Vector3f(points.nx[i], points.ny[i], points.nz[i]).cast<double>();
    Eigen::Vector3d by_live = T_live_ref.linear().transpose() * *normal;
    if (by_live.dot(by_keyframe) < 0.0) by_live = -by_live;
    const auto weight = static_cast<double>(points.weight[i]);
    Vector6 keyframe_derivative;
    keyframe_derivative << by_keyframe, point.cross(by_keyframe);
    Vector6 live_derivative;
    live_derivative << by_live, point.cross(by_live);
    agreement.add(weight * keyframe_derivative, weight * live_derivative);
  }
  return agreement;
}

}  // namespace mivo
