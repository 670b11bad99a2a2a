// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/warp.h"

#include <numeric>

#include "mivo/core/image_view.h"
#include "mivo/core/parallel_chunks.h"
#include "mivo/core/recycled.h"

namespace mivo {

Warp::Warp(const Camera& camera, const RowMotion& rows, int threads)
    : camera_(camera),
      rows_(rows),
      max_squared_radius_(static_cast<float>(camera.maxSquaredRadius())),
      threads_(threads) {}

kernels::WarpParameters Warp::parameters(const Eigen::Isometry3d& T_live_ref) const {
  kernels::WarpParameters p{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      p.rotation[3 * row + column] = static_cast<float>(T_live_ref.linear()(row, column));
    }
    p.translation[row] = static_cast<float>(T_live_ref.translation()[row]);
    p.linear[row] = static_cast<float>(rows_.twist[row]);
    p.angular[row] = static_cast<float>(rows_.twist[row + 3]);
  }
  p.has_row_motion = !rows_.isZero();
  p.height = static_cast<float>(camera_.height);
  p.fx = static_cast<float>(camera_.fx);
  p.fy = static_cast<float>(camera_.fy);
  p.cx = static_cast<float>(camera_.cx);
  p.cy = static_cast<float>(camera_.cy);
  p.is_distorted = !camera_.distortion.isZero();
  p.k1 = static_cast<float>(camera_.distortion.k1);
  p.k2 = static_cast<float>(camera_.distortion.k2);
  p.p1 = static_cast<float>(camera_.distortion.p1);
  p.p2 = static_cast<float>(camera_.distortion.p2);
  p.k3 = static_cast<float>(camera_.distortion.k3);
  p.max_squared_radius = max_squared_radius_;
  p.right = static_cast<float>(camera_.width - 1);
  p.bottom = static_cast<float>(camera_.height - 1);
  return p;
}

void Warp::sample(const ReferencePoints& points, const Eigen::Isometry3d& T_live_ref,
                  const cv::Mat& image, const ContrastMap* contrast, LiveSamples& samples) const {
  for (std::vector<float>* array : {&samples.u, &samples.v, &samples.visible, &samples.value}) {
    array->resize(points.size());
  }
  const kernels::WarpParameters warp = parameters(T_live_ref);
  const kernels::ImageView pixels = view(image);
  const kernels::Kernels& kernels = kernels::active();
  Recycled<std::vector<std::size_t>> visible;
  visible->resize(numChunks(points.size()));
  forEachChunk(points.size(), threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    const std::size_t n = end - begin;
    float* u = samples.u.data() + begin;
    float* v = samples.v.data() + begin;
    float* seen = samples.visible.data() + begin;
    float* value = samples.value.data() + begin;
    (*visible)[chunk] = kernels.warpPoints(warp, points.view(begin), n, u, v, seen);
    if (contrast != nullptr) {
      kernels.sampleNormalised(pixels, view(*contrast), u, v, seen, n, value);
    } else {
      kernels.sampleIntensity(pixels, u, v, seen, n, value);
    }
  });
  samples.num_visible = std::accumulate(visible->begin(), visible->end(), std::size_t{0});
}

}  // namespace mivo
