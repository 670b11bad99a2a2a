// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/reference_points.h"

#include <algorithm>
#include <cmath>

#include "core/execution/recycled.h"
#include "core/geometry/warp.h"
#include "core/images/pixel_access.h"

namespace mivo {
namespace {

// The pixels around a point: itself, left, right, above, below, and the corners.
enum Place { kHere, kLeft, kRight, kAbove, kBelow, kUpLeft, kUpRight, kDownLeft, kDownRight };
// intensity >= this hides a point: never. Saturated ones were left out when pixels were chosen.
constexpr float kNeverSaturated = 1e9F;
constexpr std::size_t kPlaces = 9;
constexpr std::size_t kPlacesOfGradient = 5;
constexpr int kColumnOf[kPlaces] = {0, -1, 1, 0, 0, -1, 1, -1, 1};
constexpr int kRowOf[kPlaces] = {0, 0, 0, -1, 1, -1, -1, 1, 1};

/// Intermediate results, one entry per point.
struct Workspace {
  std::vector<float> u, v, z;
  std::vector<float> place_u, place_v, is_inside;
  std::array<std::vector<float>, kPlaces> value;  // that are compared, around each point
  std::vector<float> gradient_u, gradient_v;
  std::vector<float> curvature_uu, curvature_uv, curvature_vv;

  void resize(std::size_t n) {
    for (std::vector<float>* array : {&u, &v, &z, &place_u, &place_v, &is_inside, &gradient_u,
                                      &gradient_v, &curvature_uu, &curvature_uv, &curvature_vv}) {
      array->resize(n);
    }
    for (std::vector<float>& array : value) array.resize(n);
  }
};

template <typename Value>
void sampleRaw(const cv::Mat& image, const std::vector<Pixel>& pixels, std::size_t places,
               Workspace& work) {
  const auto stride = static_cast<std::ptrdiff_t>(image.step1());
  std::ptrdiff_t offset[kPlaces];
  for (std::size_t k = 0; k < kPlaces; ++k) offset[k] = kRowOf[k] * stride + kColumnOf[k];
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Value* here = image.ptr<Value>(pixels[i].y) + pixels[i].x;
    for (std::size_t k = 0; k < places; ++k) {
      work.value[k][i] = static_cast<float>(here[offset[k]]);
    }
  }
}

void sampleNormalized(const ReferenceImage& image, const std::vector<Pixel>& pixels,
                      std::size_t places, Workspace& work) {
  const kernels::Kernels& kernels = kernels::active();
  const int last_column = image.gray.cols - 1;
  const int last_row = image.gray.rows - 1;
  for (std::size_t k = 0; k < places; ++k) {
    bool is_all_inside = true;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const int x = pixels[i].x + kColumnOf[k];
      const int y = pixels[i].y + kRowOf[k];
      // The kernel interpolates, and reads the pixels right of it and below it.
      const bool is_inside = x < last_column && y < last_row;
      work.place_u[i] = is_inside ? static_cast<float>(x) : 0.0F;
      work.place_v[i] = is_inside ? static_cast<float>(y) : 0.0F;
      work.is_inside[i] = is_inside ? 1.0F : 0.0F;
      is_all_inside = is_all_inside && is_inside;
    }
    kernels.sampleNormalized(view(image.gray), view(*image.contrast), kNeverSaturated,
                             work.place_u.data(), work.place_v.data(), work.is_inside.data(),
                             pixels.size(), work.value[k].data());
    if (is_all_inside) continue;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (work.is_inside[i] != 0.0F) continue;
      work.value[k][i] = normalizedIntensity(image.gray, *image.contrast,
                                             pixels[i].x + kColumnOf[k], pixels[i].y + kRowOf[k]);
    }
  }
}

/// Intensities, contrast and the image's derivatives at the points.
void differentiate(const ReferenceImage& image, bool with_second_derivative,
                   ReferencePoints& points, Workspace& work) {
  const std::vector<Pixel>& pixels = points.pixels;
  const bool smooths_across = image.contrast != nullptr;
  const std::size_t places = smooths_across || with_second_derivative ? kPlaces : kPlacesOfGradient;
  if (image.contrast != nullptr) {
    sampleNormalized(image, pixels, places, work);
  } else if (image.gray.type() == CV_8UC1) {
    sampleRaw<unsigned char>(image.gray, pixels, places, work);
  } else {
    sampleRaw<float>(image.gray, pixels, places, work);
  }
  const auto& value = work.value;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const float contrast =
        image.contrast != nullptr ? localContrast(*image.contrast, pixels[i].x, pixels[i].y) : 1.0F;
    points.contrast[i] = contrast;
    points.intensity[i] = contrast * value[kHere][i];
    if (smooths_across) {
      const float down = value[kDownRight][i] - value[kUpLeft][i];
      const float up = value[kUpRight][i] - value[kDownLeft][i];
      work.gradient_u[i] =
          contrast / 12.0F * (4.0F * (value[kRight][i] - value[kLeft][i]) + down + up);
      work.gradient_v[i] =
          contrast / 12.0F * (4.0F * (value[kBelow][i] - value[kAbove][i]) + down - up);
    } else {
      work.gradient_u[i] = contrast * 0.5F * (value[kRight][i] - value[kLeft][i]);
      work.gradient_v[i] = contrast * 0.5F * (value[kBelow][i] - value[kAbove][i]);
    }
    if (!with_second_derivative) continue;
    const float twice = 2.0F * value[kHere][i];
    work.curvature_uu[i] = contrast * (value[kRight][i] - twice + value[kLeft][i]);
    work.curvature_vv[i] = contrast * (value[kBelow][i] - twice + value[kAbove][i]);
    work.curvature_uv[i] =
        contrast * 0.25F *
        (value[kDownRight][i] - value[kDownLeft][i] - value[kUpRight][i] + value[kUpLeft][i]);
  }
}

/// Depth on the points' rays when their rows of the image are read: the reading is taken from where
/// the surface has moved to by the time that the depth is read, and moved back. @param points at
/// the depth that their own pixels have. @param work that depth, replaced.
void takeDepthInTime(const ReferenceDepth& depth, const Camera& camera, const Vector6& twist,
                     const ReferencePoints& points, Workspace& work) {
  const RowMotion later{twist, 0.0, depth.offset};
  const auto move = [&](const Eigen::Vector3d& X) { return later.displacement(X, 0.0, 1.0); };
  kernels::active().warpPoints(Warp(camera, later, 1).parameters(Eigen::Isometry3d::Identity()),
                               points.view(0), points.size(), work.place_u.data(),
                               work.place_v.data(), work.is_inside.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (work.is_inside[i] == 0.0F) continue;
    const float u = std::round(work.place_u[i]);
    const float v = std::round(work.place_v[i]);
    const auto reading =
        static_cast<double>(depth.meters.ptr<float>(static_cast<int>(v))[static_cast<int>(u)]);
    if (!(reading > 0.0)) continue;
    // The ray of a pixel half a pixel away at most: the lens bends both alike.
    const Eigen::Vector3d point =
        Eigen::Vector3f(points.x[i], points.y[i], points.z[i]).cast<double>();
    Eigen::Vector3d seen = point + move(point);
    seen *= reading / seen.z();
    seen.x() += reading * static_cast<double>(u - work.place_u[i]) / camera.fx;
    seen.y() += reading * static_cast<double>(v - work.place_v[i]) / camera.fy;
    const double moved_back = (seen - move(seen)).z();
    if (moved_back > 0.5 * reading) work.z[i] = static_cast<float>(moved_back);
  }
}

float median(const std::vector<float>& values) {
  Recycled<std::vector<float>> copy;
  *copy = values;
  const auto middle = copy->begin() + static_cast<std::ptrdiff_t>(copy->size() / 2);
  std::nth_element(copy->begin(), middle, copy->end());
  return *middle;
}

void resize(std::size_t n, bool with_second_derivative, ReferencePoints& points) {
  for (std::vector<float>* array :
       {&points.x, &points.y, &points.z, &points.intensity, &points.contrast}) {
    array->resize(n);
  }
  for (std::vector<float>& array : points.jacobian) array.resize(n);
  for (std::vector<float>& array : points.second_derivative) {
    array.resize(with_second_derivative ? n : 0);
  }
}

/// Points and derivatives by the kernel.
void derive(const kernels::WarpParameters& camera, bool with_second_derivative,
            const Workspace& work, ReferencePoints& points) {
  const kernels::PixelsView pixels = {work.u.data(),
                                      work.v.data(),
                                      work.z.data(),
                                      work.gradient_u.data(),
                                      work.gradient_v.data(),
                                      with_second_derivative ? work.curvature_uu.data() : nullptr,
                                      with_second_derivative ? work.curvature_uv.data() : nullptr,
                                      with_second_derivative ? work.curvature_vv.data() : nullptr};
  kernels::DerivedPoints derived = {points.x.data(), points.y.data(), points.z.data(), {}, {}};
  for (std::size_t k = 0; k < 6; ++k) derived.jacobian[k] = points.jacobian[k].data();
  if (with_second_derivative) {
    for (std::size_t k = 0; k < kSymmetric6; ++k) {
      derived.second_derivative[k] = points.second_derivative[k].data();
    }
  }
  double motion[kSymmetric6] = {};
  kernels::active().keyframePoints(camera, pixels, points.size(), derived, motion);
  const double* entry = motion;
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(1, points.size()));
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      points.pixel_motion(row, column) = points.pixel_motion(column, row) = share * *entry++;
    }
  }
}

}  // namespace

void makeReferencePoints(const ReferenceImage& image, const ReferenceDepth& depth,
                         const Camera& camera, const RowMotion& rows, bool with_second_derivative,
                         ReferencePoints& points) {
  const std::vector<Pixel>& pixels = points.pixels;
  const std::size_t n = pixels.size();
  resize(n, with_second_derivative, points);
  Recycled<Workspace> work;
  work->resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    work->u[i] = static_cast<float>(pixels[i].x);
    work->v[i] = static_cast<float>(pixels[i].y);
    work->z[i] = depth.meters.ptr<float>(pixels[i].y)[pixels[i].x];
  }
  differentiate(image, with_second_derivative, points, *work);
  const auto deriveWith = [&](const RowMotion& motion) {
    derive(Warp(camera, motion, 1).parameters(Eigen::Isometry3d::Identity()),
           with_second_derivative, *work, points);
  };
  if (depth.offset != 0.0) {
    deriveWith(RowMotion{});  // on their rays, when their own rows are read
    takeDepthInTime(depth, camera, rows.twist, points, *work);
  }
  deriveWith(rows);
  points.median_depth = n > 0 ? median(points.z) : 1.0F;
}

}  // namespace mivo
