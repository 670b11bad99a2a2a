// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/geometric_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/execution/recycled.h"

namespace mivo {
namespace {

// Pixels of the level: a patch is 7 x 7. Smaller ones are tilted by the steps of the disparity,
// larger ones find few planes.
constexpr int kRadius = 3;
// Pixels between patches: no surface of 9 x 9 pixels is missed.
constexpr int kStep = 3;
constexpr double kPatchSize = (2 * kRadius + 1) * (2 * kRadius + 1);
// Sum of u^2 over the patch: 7 (1 + 4 + 9) 2.
constexpr double kSquares = 196.0;
// Root of the mean of u^2: pixels to each side at which second differences give the patch's mean.
constexpr int kBendStep = 2;
// residuals <= this many deviations of a reading, root mean square: the patch is planar. Noise
// alone has one; two is noise that the sensor's model underrates, and not yet an edge.
constexpr double kPlanar = 2.0;
// |cos| of ray and normal > this: surfaces seen at a flatter angle than 17 degrees have no
// reliable depth.
constexpr double kMinCosine = 0.3;
// Directions of normals: 4 rings of 8 sectors. Surfaces at right angles never share one.
constexpr int kRings = 4;
constexpr int kSectors = 8;

struct Patch {
  std::size_t place;  // in reading order
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
};

struct Plane {
  double center;  // 1/z at the pixel: 1/z is linear in the pixel for a plane
  double slope_u;
  double slope_v;
};

/// Sums over the 7 rows of a patch's column: of 1/z, times the row, and squared.
struct ColumnSums {
  std::vector<double> inverse;
  std::vector<double> times_row;
  std::vector<double> squares;
};

/// Rays through the middle of the patches, and the derivative of pixels with respect to them: of a
/// camera with a lens they are costly, and the camera stays the same.
struct PatchRays {
  Camera camera;
  std::vector<Eigen::Vector3d> ray;  // row by row; zero where the lens has none
  std::vector<Eigen::Matrix2d> scale;
  std::vector<Eigen::Vector2d> bend;  // the mean over the patch less the ray: a lens bends rows
};

/// Intermediate results, and what can be used again for the next keyframe.
struct Workspace {
  PatchRays rays;
  std::vector<float> inverse;  // 1/z of the whole image
  ColumnSums columns;
  std::vector<std::vector<Patch>> bins;
  std::vector<Patch> spread;
  std::vector<Patch> chosen;
};

/// Mean of the normalized coordinates over the patch around a pixel less those of the pixel, from
/// second differences; zero at the rim of the lens.
Eigen::Vector2d bendAround(int x, int y, const Camera& camera, const LensRange& range) {
  const auto middle = camera.ray({x, y}, range);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [u, v] :
       {std::pair{-kBendStep, 0}, {kBendStep, 0}, {0, -kBendStep}, {0, kBendStep}}) {
    const auto ray = camera.ray({x + u, y + v}, range);
    if (!middle || !ray) return Eigen::Vector2d::Zero();
    sum += *ray - *middle;
  }
  return 0.5 * sum.head<2>();
}

void findRays(const Camera& camera, PatchRays& rays) {
  if (rays.camera == camera) return;
  rays.camera = camera;
  rays.ray.clear();
  rays.scale.clear();
  rays.bend.clear();
  const LensRange range = camera.lensRange();
  for (int y = kRadius; y + kRadius < camera.height; y += kStep) {
    for (int x = kRadius; x + kRadius < camera.width; x += kStep) {
      rays.ray.push_back(camera.ray({x, y}, range).value_or(Eigen::Vector3d::Zero()));
      Eigen::Matrix2d scale = Eigen::Matrix2d::Identity();
      Eigen::Vector2d bend = Eigen::Vector2d::Zero();
      if (!camera.distortion.isZero()) {
        camera.distort(rays.ray.back().head<2>(), &scale);
        bend = bendAround(x, y, camera, range);
      }
      rays.bend.push_back(bend);
      rays.scale.emplace_back(Eigen::Vector2d(camera.fx, camera.fy).asDiagonal() * scale);
    }
  }
}

/// A hole becomes infinite, and whatever is made of the sums it gets into is not a number.
void invert(const cv::Mat& depth, std::vector<float>& inverse) {
  inverse.resize(depth.total());
  float* out = inverse.data();
  for (int y = 0; y < depth.rows; ++y, out += depth.cols) {
    const auto* row = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) out[x] = 1.0F / row[x];
  }
}

/// The sums of each column around row y.
void sumColumns(const std::vector<float>& inverse, int y, std::size_t width, ColumnSums& sums) {
  sums.inverse.resize(width);
  sums.times_row.resize(width);
  sums.squares.resize(width);
  static_assert(kRadius == 3, "seven rows are added below");
  const float* middle = inverse.data() + static_cast<std::size_t>(y) * width;
  const auto stride = static_cast<std::ptrdiff_t>(width);
  for (std::ptrdiff_t x = 0; x < stride; ++x) {
    const float* at = middle + x;
    const auto a = static_cast<double>(at[-3 * stride]);
    const auto b = static_cast<double>(at[-2 * stride]);
    const auto c = static_cast<double>(at[-stride]);
    const auto d = static_cast<double>(at[0]);
    const auto e = static_cast<double>(at[stride]);
    const auto f = static_cast<double>(at[2 * stride]);
    const auto g = static_cast<double>(at[3 * stride]);
    const auto i = static_cast<std::size_t>(x);
    sums.inverse[i] = a + b + c + d + e + f + g;
    sums.times_row[i] = 3.0 * (g - a) + 2.0 * (f - b) + (e - c);
    sums.squares[i] = a * a + b * b + c * c + d * d + e * e + f * f + g * g;
  }
}

/// The least squares plane of the patch around column x: 1, u and v are at right angles to each
/// other over it, so the sums give the plane and what is left.
bool fitPlane(const ColumnSums& columns, int x, Plane& plane) {
  double sum = 0.0;
  double sum_u = 0.0;
  double sum_v = 0.0;
  double squares = 0.0;
  for (int u = -kRadius; u <= kRadius; ++u) {
    const auto i = static_cast<std::size_t>(x + u);
    sum += columns.inverse[i];
    sum_u += u * columns.inverse[i];
    sum_v += columns.times_row[i];
    squares += columns.squares[i];
  }
  plane = {sum / kPatchSize, sum_u / kSquares, sum_v / kSquares};
  const double rest = squares - kPatchSize * plane.center * plane.center -
                      kSquares * (plane.slope_u * plane.slope_u + plane.slope_v * plane.slope_v);
  const auto deviation =
      static_cast<double>(depthDeviation(static_cast<float>(1.0 / plane.center)));
  const double bound = kPlanar * deviation * plane.center * plane.center;  // of 1/z
  return rest <= kPatchSize * bound * bound;                               // false for NaN
}

/// Point and normal of a plane in the optical frame; false when it is seen too flatly, or by a
/// pixel without a ray.
bool toPatch(const Plane& plane, const PatchRays& rays, std::size_t i, Patch& patch) {
  // 1/z = center + g . (m - m0) in normalized coordinates m, hence g . (X, Y) + c Z = 1.
  const Eigen::Vector3d& ray = rays.ray[i];
  const Eigen::Vector2d g =
      rays.scale[i].transpose() * Eigen::Vector2d(plane.slope_u, plane.slope_v);
  const double center = plane.center - g.dot(rays.bend[i]);
  const Eigen::Vector3d normal =
      Eigen::Vector3d(g.x(), g.y(), center - g.dot(ray.head<2>())).normalized();
  patch.point = ray / center;
  patch.normal = normal;
  return std::abs(normal.dot(ray)) > kMinCosine * ray.norm();
}

/// Number of the sector of 45 degrees that a direction lies in.
int sectorOf(double x, double y) {
  const int half = y < 0.0 ? 4 : 0;
  if (y < 0.0) {
    x = -x;
    y = -y;
  }
  if (x > 0.0) return half + (y < x ? 0 : 1);
  return half + (y > -x ? 2 : 3);
}

std::size_t directionBin(const Eigen::Vector3d& normal) {
  // Cosines of the tilts between the rings: 22.5, 45 and 67.5 degrees.
  constexpr std::array<double, kRings - 1> kCosines = {0.92387953251128674, 0.70710678118654752,
                                                       0.38268343236508977};
  const double upright = std::abs(normal.z());
  int ring = 0;
  while (ring < kRings - 1 && upright <= kCosines[static_cast<std::size_t>(ring)]) ++ring;
  return static_cast<std::size_t>(ring == 0 ? 0
                                            : ring * kSectors + sectorOf(normal.x(), normal.y()));
}

/// Bin by bin the first of each, then the second of each: any number of them covers all directions.
/// Within a bin the patches are spread over the image by a fixed stride.
void chooseInTurn(std::size_t wanted, Workspace& work) {
  work.chosen.clear();
  for (std::vector<Patch>& bin : work.bins) {
    work.spread.clear();
    constexpr std::size_t kStride = 7;
    for (std::size_t first = 0; first < kStride; ++first) {
      for (std::size_t i = first; i < bin.size(); i += kStride) work.spread.push_back(bin[i]);
    }
    bin = work.spread;  // a copy: each keeps its memory
  }
  for (std::size_t rank = 0; work.chosen.size() < wanted; ++rank) {
    bool is_empty = true;
    for (const std::vector<Patch>& bin : work.bins) {
      if (rank >= bin.size()) continue;
      is_empty = false;
      if (work.chosen.size() < wanted) work.chosen.push_back(bin[rank]);
    }
    if (is_empty) break;
  }
}

/// Puts the first part into reading order: what lies side by side in the live depth image is read
/// there one after the other.
void sortFirstPart(std::size_t first_part, std::vector<Patch>& chosen) {
  const auto end =
      chosen.begin() + static_cast<std::ptrdiff_t>(std::min(first_part, chosen.size()));
  std::sort(chosen.begin(), end, [](const Patch& a, const Patch& b) { return a.place < b.place; });
}

/// Planar patches over the image, by the direction of their normals.
void findPatches(const cv::Mat& depth, const Camera& camera, const RowMotion& rows,
                 Workspace& work) {
  work.bins.resize(static_cast<std::size_t>(kRings * kSectors));
  for (std::vector<Patch>& bin : work.bins) bin.clear();
  findRays(camera, work.rays);
  invert(depth, work.inverse);
  std::size_t i = 0;
  for (int y = kRadius; y + kRadius < depth.rows; y += kStep) {
    sumColumns(work.inverse, y, static_cast<std::size_t>(depth.cols), work.columns);
    for (int x = kRadius; x + kRadius < depth.cols; x += kStep, ++i) {
      Plane plane{};
      Patch patch;
      patch.place = i;
      if (!fitPlane(work.columns, x, plane) || !toPatch(plane, work.rays, i, patch)) {
        continue;
      }
      patch.point -= rows.displacement(patch.point, y, camera.height);
      work.bins[directionBin(patch.normal)].push_back(patch);
    }
  }
}

}  // namespace

void makeGeometricPoints(const cv::Mat& depth, const Camera& camera, const RowMotion& rows,
                         int first_part, int max_points, GeometricPoints& points) {
  Recycled<Workspace> work;
  findPatches(depth, camera, rows, *work);
  chooseInTurn(static_cast<std::size_t>(max_points), *work);
  sortFirstPart(static_cast<std::size_t>(first_part), work->chosen);
  const std::vector<Patch>& chosen = work->chosen;
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
}

}  // namespace mivo
