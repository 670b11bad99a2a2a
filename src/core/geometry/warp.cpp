// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/warp.h"

#include "core/execution/parallel_chunks.h"
#include "core/execution/recycled.h"
#include "core/images/pixel_access.h"

namespace mivo {
namespace {

kernels::Lens lensOf(const Distortion& distortion) {
  if (distortion.model == LensModel::kEquidistant) return kernels::Lens::kEquidistant;
  if (distortion.isRational()) return kernels::Lens::kRational;
  return distortion.isZero() ? kernels::Lens::kNone : kernels::Lens::kPlumbBob;
}

}  // namespace

Warp::Warp(const Camera& camera, const RowMotion& rows, int threads)
    : camera_(camera),
      rows_(rows),
      max_radius_(static_cast<float>(camera.lensRange().undistorted)),
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
  p.row_duration = static_cast<float>(rows_.readout / camera_.height);
  p.first_row = static_cast<float>(rows_.offset - 0.5 * rows_.readout);
  p.fx = static_cast<float>(camera_.fx);
  p.fy = static_cast<float>(camera_.fy);
  p.cx = static_cast<float>(camera_.cx);
  p.cy = static_cast<float>(camera_.cy);
  p.lens = lensOf(camera_.distortion);
  p.k1 = static_cast<float>(camera_.distortion.k1);
  p.k2 = static_cast<float>(camera_.distortion.k2);
  p.p1 = static_cast<float>(camera_.distortion.p1);
  p.p2 = static_cast<float>(camera_.distortion.p2);
  p.k3 = static_cast<float>(camera_.distortion.k3);
  p.k4 = static_cast<float>(camera_.distortion.k4);
  p.k5 = static_cast<float>(camera_.distortion.k5);
  p.k6 = static_cast<float>(camera_.distortion.k6);
  p.max_squared_radius = max_radius_ * max_radius_;
  p.right = static_cast<float>(camera_.width - 1);
  p.bottom = static_cast<float>(camera_.height - 1);
  return p;
}

/// @param sample_chunk called with a range of points that are warped; returns how many it hid.
template <typename SampleChunk>
void Warp::sampleChunks(const ReferencePoints& points, std::size_t num_points,
                        const Eigen::Isometry3d& T_live_ref, LiveSamples& samples,
                        const SampleChunk& sample_chunk) const {
  for (std::vector<float>* array : {&samples.u, &samples.v, &samples.visible, &samples.value}) {
    array->resize(num_points);
  }
  const kernels::WarpParameters warp = parameters(T_live_ref);
  struct Counts {
    std::size_t in_view;
    std::size_t hidden;
  };
  Recycled<std::vector<Counts>> counts;
  counts->resize(numChunks(num_points));
  forEachChunk(num_points, threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    const std::size_t in_view = kernels::active().warpPoints(
        warp, points.view(begin), end - begin, samples.u.data() + begin, samples.v.data() + begin,
        samples.visible.data() + begin);
    (*counts)[chunk] = {in_view, sample_chunk(begin, end - begin)};
  });
  samples.num_in_view = 0;
  samples.num_visible = 0;
  for (const Counts& part : *counts) {
    samples.num_in_view += part.in_view;
    samples.num_visible += part.in_view - part.hidden;
  }
}

void Warp::sample(const ReferencePoints& points, std::size_t num_points,
                  const Eigen::Isometry3d& T_live_ref, const cv::Mat& image,
                  LiveSamples& samples) const {
  const kernels::ImageView pixels = view(image);
  sampleChunks(points, num_points, T_live_ref, samples, [&](std::size_t begin, std::size_t n) {
    kernels::active().sampleIntensity(pixels, samples.u.data() + begin, samples.v.data() + begin,
                                      samples.visible.data() + begin, n,
                                      samples.value.data() + begin);
    return std::size_t{0};
  });
}

void Warp::sampleNormalized(const ReferencePoints& points, std::size_t num_points,
                            const Eigen::Isometry3d& T_live_ref, const cv::Mat& image,
                            const ContrastMap& contrast, double saturation,
                            LiveSamples& samples) const {
  const kernels::ImageView pixels = view(image);
  const kernels::ContrastView maps = view(contrast);
  sampleChunks(points, num_points, T_live_ref, samples, [&](std::size_t begin, std::size_t n) {
    return kernels::active().sampleNormalized(
        pixels, maps, static_cast<float>(saturation), samples.u.data() + begin,
        samples.v.data() + begin, samples.visible.data() + begin, n, samples.value.data() + begin);
  });
}

}  // namespace mivo
