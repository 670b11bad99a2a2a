// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/geometric_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mivo {
namespace {

constexpr int kRadius = 3;  // pixels of the level: a patch is 7 x 7
constexpr int kStep = 3;    // pixels between patches
constexpr float kPatchSize = (2 * kRadius + 1) * (2 * kRadius + 1);
// Sum of u^2 over the patch: 7 (1 + 4 + 9) 2.
constexpr float kSquares = 196.0F;
// A patch is planar when its residuals are at most this many deviations of a reading.
constexpr float kPlanar = 2.0F;
// Surfaces seen at a flatter angle have no reliable depth.
constexpr double kMinCosine = 0.3;
// Directions of normals: 4 rings of 8 sectors.
constexpr int kRings = 4;
constexpr int kSectors = 8;

struct Patch {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
};

struct Plane {
  float centre;  // 1/z at the pixel: 1/z is linear in the pixel for a plane
  float slope_u;
  float slope_v;
};

bool fitPlane(const cv::Mat& depth, int x, int y, Plane& plane) {
  float sum = 0.0F;
  float sum_u = 0.0F;
  float sum_v = 0.0F;
  std::array<float, static_cast<std::size_t>(kPatchSize)> inverse;
  std::size_t i = 0;
  for (int v = -kRadius; v <= kRadius; ++v) {
    const auto* row = depth.ptr<float>(y + v) + x;
    for (int u = -kRadius; u <= kRadius; ++u, ++i) {
      if (row[u] <= 0.0F) return false;
      inverse[i] = 1.0F / row[u];
      sum += inverse[i];
      sum_u += static_cast<float>(u) * inverse[i];
      sum_v += static_cast<float>(v) * inverse[i];
    }
  }
  plane = {sum / kPatchSize, sum_u / kSquares, sum_v / kSquares};
  float squares = 0.0F;
  i = 0;
  for (int v = -kRadius; v <= kRadius; ++v) {
    for (int u = -kRadius; u <= kRadius; ++u, ++i) {
      const float residual = inverse[i] - plane.centre - static_cast<float>(u) * plane.slope_u -
                             static_cast<float>(v) * plane.slope_v;
      squares += residual * residual;
    }
  }
  const float z = 1.0F / plane.centre;
  const float bound = kPlanar * depthDeviation(z) * plane.centre * plane.centre;  // of 1/z
  return squares <= kPatchSize * bound * bound;
}

/// Point and normal of a plane in the optical frame; false when it is seen too flatly.
bool toPatch(const Plane& plane, int x, int y, const Camera& camera, Patch& patch) {
  const Eigen::Vector3d ray = camera.ray({x, y});
  Eigen::Matrix2d scale = Eigen::Matrix2d::Identity();
  if (!camera.distortion.isZero()) camera.distort(ray.head<2>(), &scale);
  scale = Eigen::Vector2d(camera.fx, camera.fy).asDiagonal() * scale;
  // 1/z = centre + g . (m - m0) in normalised coordinates m, hence g . (X, Y) + c Z = 1.
  const Eigen::Vector2d g = scale.transpose() * Eigen::Vector2d(plane.slope_u, plane.slope_v);
  const double centre = static_cast<double>(plane.centre);
  const Eigen::Vector3d normal =
      Eigen::Vector3d(g.x(), g.y(), centre - g.dot(ray.head<2>())).normalized();
  patch = {ray / centre, normal};
  return std::abs(normal.dot(ray)) > kMinCosine * ray.norm();
}

std::size_t directionBin(const Eigen::Vector3d& normal) {
  constexpr double kPi = 3.14159265358979323846;
  const double tilt = std::acos(std::min(1.0, std::abs(normal.z()))) / (0.5 * kPi);
  const double turn = (std::atan2(normal.y(), normal.x()) + kPi) / (2.0 * kPi);
  const int ring = std::min(kRings - 1, static_cast<int>(tilt * kRings));
  const int sector = std::min(kSectors - 1, static_cast<int>(turn * kSectors));
  return static_cast<std::size_t>(ring == 0 ? 0 : ring * kSectors + sector);
}

/// Bin by bin the first of each, then the second of each: any number of them covers all directions.
/// Within a bin the patches are spread over the image by a fixed stride.
std::vector<Patch> inTurn(std::vector<std::vector<Patch>>& bins, std::size_t wanted) {
  std::vector<Patch> chosen;
  for (std::vector<Patch>& bin : bins) {
    std::vector<Patch> spread;
    spread.reserve(bin.size());
    constexpr std::size_t kStride = 7;
    for (std::size_t first = 0; first < kStride; ++first) {
      for (std::size_t i = first; i < bin.size(); i += kStride) spread.push_back(bin[i]);
    }
    bin = std::move(spread);
  }
  for (std::size_t rank = 0; chosen.size() < wanted; ++rank) {
    bool is_empty = true;
    for (const std::vector<Patch>& bin : bins) {
      if (rank >= bin.size()) continue;
      is_empty = false;
      if (chosen.size() < wanted) chosen.push_back(bin[rank]);
    }
    if (is_empty) break;
  }
  return chosen;
}

}  // namespace

void makeGeometricPoints(const cv::Mat& depth, const Camera& camera, const RowMotion& rows,
                         int max_points, GeometricPoints& points) {
  std::vector<std::vector<Patch>> bins(static_cast<std::size_t>(kRings * kSectors));
  for (int y = kRadius; y + kRadius < depth.rows; y += kStep) {
    for (int x = kRadius; x + kRadius < depth.cols; x += kStep) {
      Plane plane{};
      Patch patch;
      if (!fitPlane(depth, x, y, plane) || !toPatch(plane, x, y, camera, patch)) continue;
      patch.point -= rows.displacement(patch.point, y, camera.height);
      bins[directionBin(patch.normal)].push_back(patch);
    }
  }
  const std::vector<Patch> chosen = inTurn(bins, static_cast<std::size_t>(max_points));
  for (std::vector<float>* array :
       {&points.x, &points.y, &points.z, &points.nx, &points.ny, &points.nz, &points.weight}) {
    array->resize(chosen.size());
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    points.x[i] = static_cast<float>(chosen[i].point.x());
    points.y[i] = static_cast<float>(chosen[i].point.y());
    points.z[i] = static_cast<float>(chosen[i].point.z());
    points.nx[i] = static_cast<float>(chosen[i].normal.x());
    points.ny[i] = static_cast<float>(chosen[i].normal.y());
    points.nz[i] = static_cast<float>(chosen[i].normal.z());
    points.weight[i] = 1.0F / depthDeviation(points.z[i]);
  }
  std::vector<float> depths = points.z;
  if (!depths.empty()) {
    std::nth_element(depths.begin(),
                     depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2), depths.end());
  }
  points.median_depth = depths.empty() ? 1.0F : depths[depths.size() / 2];
}

}  // namespace mivo
