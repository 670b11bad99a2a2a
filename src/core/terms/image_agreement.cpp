// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/image_agreement.h"

#include <algorithm>
#include <array>

#include "core/execution/recycled.h"
#include "core/images/pixel_access.h"
#include "core/kernels/kernels.h"

namespace mivo {
namespace {

// intensity >= this hides a point: never. Clipped pixels have been left out of `visible`.
constexpr float kNeverSaturated = 1e9F;

/// Live pixels of some points, moved by whole pixels, and what the image shows there.
struct Neighbor {
  std::vector<float> u, v, visible, value;
};

/// The eight pixels around one.
enum Place { kLeft, kRight, kAbove, kBelow, kUpLeft, kUpRight, kDownLeft, kDownRight, kPlaces };
constexpr float kColumnOf[kPlaces] = {-1, 1, 0, 0, -1, 1, -1, 1};
constexpr float kRowOf[kPlaces] = {0, 0, -1, 1, -1, -1, 1, 1};

struct Workspace {
  std::vector<std::size_t> index;
  std::array<Neighbor, kPlaces> around;

  bool isSeen(std::size_t k) const {
    return std::all_of(around.begin(), around.end(),
                       [k](const Neighbor& place) { return place.visible[k] != 0.0F; });
  }

  /// Central differences, smoothed across by (1, 4, 1) / 6: of an oblique edge they point across
  /// it, however sharp it is. Those of the keyframe do not quite, and what two images have in
  /// common by that would pass for something to see along the edge.
  Eigen::Vector2d gradient(std::size_t k) const {
    const auto value = [&](Place place) {
      return static_cast<double>(around[static_cast<std::size_t>(place)].value[k]);
    };
    const double right = value(kUpRight) + 4.0 * value(kRight) + value(kDownRight);
    const double left = value(kUpLeft) + 4.0 * value(kLeft) + value(kDownLeft);
    const double below = value(kDownLeft) + 4.0 * value(kBelow) + value(kDownRight);
    const double above = value(kUpLeft) + 4.0 * value(kAbove) + value(kUpRight);
    return {(right - left) / 12.0, (below - above) / 12.0};
  }
};

void sample(const LiveImage& image, const Workspace& work, const LiveSamples& samples, float du,
            float dv, Neighbor& neighbor) {
  const std::size_t n = work.index.size();
  for (std::vector<float>* array : {&neighbor.u, &neighbor.v, &neighbor.visible, &neighbor.value}) {
    array->reserve(work.index.capacity());  // how many are seen differs from frame to frame
    array->assign(n, 0.0F);
  }
  const auto right = static_cast<float>(image.gray.cols - 1);
  const auto bottom = static_cast<float>(image.gray.rows - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const float u = samples.u[work.index[i]] + du;
    const float v = samples.v[work.index[i]] + dv;
    if (!(u >= 0.0F && u < right && v >= 0.0F && v < bottom)) continue;
    neighbor.u[i] = u;
    neighbor.v[i] = v;
    neighbor.visible[i] = 1.0F;
  }
  const kernels::Kernels& kernels = kernels::active();
  if (image.contrast != nullptr) {
    kernels.sampleNormalized(view(image.gray), view(*image.contrast), kNeverSaturated,
                             neighbor.u.data(), neighbor.v.data(), neighbor.visible.data(), n,
                             neighbor.value.data());
  } else {
    kernels.sampleIntensity(view(image.gray), neighbor.u.data(), neighbor.v.data(),
                            neighbor.visible.data(), n, neighbor.value.data());
  }
}

/// Derivative of the live intensity with respect to the increment, which moves the keyframe's point
/// X to exp(w) X + v before it is warped: gradient . d pixel / d Y . R [1, -skew(X)], Y = T X.
Vector6 liveDerivative(const Eigen::Vector3d& point, const Eigen::Isometry3d& T_live_ref,
                       const Camera& camera, const Eigen::Vector2d& gradient) {
  const Eigen::Vector3d seen = T_live_ref * point;
  const double x = seen.x() / seen.z();
  const double y = seen.y() / seen.z();
  const Eigen::Vector3d by_seen(
      gradient.x() * camera.fx / seen.z(), gradient.y() * camera.fy / seen.z(),
      -(gradient.x() * camera.fx * x + gradient.y() * camera.fy * y) / seen.z());
  const Eigen::Vector3d by_point = T_live_ref.linear().transpose() * by_seen;
  Vector6 derivative;
  derivative << by_point, point.cross(by_point);
  return derivative;
}

}  // namespace

Agreement imageAgreement(const ReferencePoints& points, const LiveImage& image,
                         const LiveSamples& samples, const std::vector<float>& visible,
                         const Warp& warp, const Eigen::Isometry3d& T_live_ref,
                         std::size_t most_points) {
  Recycled<Workspace> work;
  work->index.clear();
  work->index.reserve(visible.size());
  const std::size_t stride =
      std::max<std::size_t>(1, visible.size() / std::max<std::size_t>(1, most_points));
  for (std::size_t i = 0; i < visible.size(); i += stride) {
    if (visible[i] != 0.0F) work->index.push_back(i);
  }
  for (std::size_t place = 0; place < kPlaces; ++place) {
    sample(image, *work, samples, kColumnOf[place], kRowOf[place], work->around[place]);
  }
  Agreement agreement;
  agreement.has_steps = true;
  for (std::size_t k = 0; k < work->index.size(); ++k) {
    if (!work->isSeen(k)) continue;
    const std::size_t i = work->index[k];
    const Eigen::Vector2d gradient = static_cast<double>(points.contrast[i]) * work->gradient(k);
    const Eigen::Vector3d point =
        Eigen::Vector3f(points.x[i], points.y[i], points.z[i]).cast<double>();
    Vector6 by_keyframe;
    for (int j = 0; j < 6; ++j) {
      by_keyframe[j] = static_cast<double>(points.jacobian[static_cast<std::size_t>(j)][i]);
    }
    agreement.add(by_keyframe, liveDerivative(point, T_live_ref, warp.camera(), gradient));
  }
  return agreement;
}

}  // namespace mivo
