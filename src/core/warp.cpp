// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/warp.h"

#include <cmath>
#include <numeric>

#include "mivo/core/parallel_chunks.h"

namespace mivo {

Warp::Warp(const Camera& camera, int threads)
    : camera_(camera),
      max_squared_radius_(static_cast<float>(camera.maxSquaredRadius())),
      is_distorted_(!camera.distortion.isZero()),
      threads_(threads) {}

void Warp::sample(const ReferencePoints& points, const Eigen::Isometry3d& T_live_ref,
                  const cv::Mat& image, LiveSamples& samples) const {
  samples.intensity.resize(points.size());
  samples.visible.resize(points.size());
  std::vector<std::size_t> visible(numChunks(points.size()));
  forEachChunk(points.size(), threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    visible[chunk] = sampleChunk(points, T_live_ref, image, begin, end, samples);
  });
  samples.num_visible = std::accumulate(visible.begin(), visible.end(), std::size_t{0});
}

std::size_t Warp::sampleChunk(const ReferencePoints& points, const Eigen::Isometry3d& T_live_ref,
                              const cv::Mat& image, std::size_t begin, std::size_t end,
                              LiveSamples& samples) const {
  const Eigen::Matrix3f R = T_live_ref.linear().cast<float>();
  const Eigen::Vector3f t = T_live_ref.translation().cast<float>();
  const auto fx = static_cast<float>(camera_.fx);
  const auto fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx);
  const auto cy = static_cast<float>(camera_.cy);
  const auto k1 = static_cast<float>(camera_.distortion.k1);
  const auto k2 = static_cast<float>(camera_.distortion.k2);
  const auto k3 = static_cast<float>(camera_.distortion.k3);
  const auto p1 = static_cast<float>(camera_.distortion.p1);
  const auto p2 = static_cast<float>(camera_.distortion.p2);
  const auto right = static_cast<float>(image.cols - 1);
  const auto bottom = static_cast<float>(image.rows - 1);
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const float px = points.x[i];
    const float py = points.y[i];
    const float pz = points.z[i];
    const float z = R(2, 0) * px + R(2, 1) * py + R(2, 2) * pz + t.z();
    const float inverse = 1.0F / z;
    float u = (R(0, 0) * px + R(0, 1) * py + R(0, 2) * pz + t.x()) * inverse;
    float v = (R(1, 0) * px + R(1, 1) * py + R(1, 2) * pz + t.y()) * inverse;
    bool visible = z > 0.0F;
    if (is_distorted_) {
      const float r2 = u * u + v * v;
      const float radial = 1.0F + r2 * (k1 + r2 * (k2 + r2 * k3));
      const float uv2 = 2.0F * u * v;
      visible = visible && r2 <= max_squared_radius_;
      const float distorted = u * radial + p1 * uv2 + p2 * (r2 + 2.0F * u * u);
      v = v * radial + p1 * (r2 + 2.0F * v * v) + p2 * uv2;
      u = distorted;
    }
    u = fx * u + cx;
    v = fy * v + cy;
    // Written so that NaN is outside.
    visible = visible && u >= 0.0F && v >= 0.0F && u < right && v < bottom;
    samples.visible[i] = visible ? 1 : 0;
    if (!visible) {
      samples.intensity[i] = 0.0F;
      continue;
    }
    const int column = static_cast<int>(u);  // not negative: truncation is the floor
    const int row = static_cast<int>(v);
    const float du = u - static_cast<float>(column);
    const float dv = v - static_cast<float>(row);
    const float* upper = image.ptr<float>(row) + column;
    const float* lower = image.ptr<float>(row + 1) + column;
    const float top = upper[0] + du * (upper[1] - upper[0]);
    const float low = lower[0] + du * (lower[1] - lower[0]);
    samples.intensity[i] = top + dv * (low - top);
    ++count;
  }
  return count;
}

}  // namespace mivo
