// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/keyframe.h"

#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

void selectPoints(const cv::Mat& image, const cv::Mat& depth, bool is_coarsest,
                  const Parameters& parameters, std::vector<Pixel>& pixels) {
  if (is_coarsest || parameters.point_fraction == 1.0) {
    selectAll(depth, pixels);
    return;
  }
  const double wanted = parameters.point_fraction * static_cast<double>(image.total());
  SelectionLimits limits{};
  limits.num_points = std::max(parameters.min_points, static_cast<int>(std::lround(wanted)));
  limits.min_gradient = static_cast<float>(parameters.min_gradient);
  limits.cell_size = parameters.point_cell_size;
  limits.depth_edge_ratio = static_cast<float>(parameters.depth_edge_ratio);
  selectSalient(image, depth, limits, pixels);
}

template <typename Value>
void leaveOutAbove(const cv::Mat& image, Value limit, std::vector<Pixel>& pixels) {
  const auto stride = static_cast<std::ptrdiff_t>(image.step1());
  std::size_t count = 0;
  for (const Pixel& pixel : pixels) {
    const Value* row = image.ptr<Value>(pixel.y) + pixel.x - stride;
    Value highest = row[0];
    for (int y = 0; y < 3; ++y, row += stride) {
      highest = std::max({highest, row[-1], row[0], row[1]});
    }
    pixels[count] = pixel;
    count += highest < limit ? 1U : 0U;  // no branch: nothing foresees it
  }
  pixels.resize(count);
}

/// Pixels with a neighbour that may be clipped: their gradient is not that of the scene.
void leaveOutSaturated(const cv::Mat& image, double saturation, std::vector<Pixel>& pixels) {
  if (image.type() == CV_8UC1) {
    // Whole numbers: what reaches the limit reaches the next one above it.
    const double limit = std::ceil(saturation);
    if (limit <= 255.0) leaveOutAbove(image, static_cast<unsigned char>(limit), pixels);
  } else {
    leaveOutAbove(image, static_cast<float>(saturation), pixels);
  }
}

}  // namespace

void Keyframe::build(const FramePyramid& frame, const Camera& camera,
                     const Vector6& twist_per_period, const ShutterTimes& shutter,
                     const Parameters& parameters) {
  choosePoints(frame, twist_per_period, shutter, parameters);
  finish(frame, camera, parameters);
}

void Keyframe::choosePoints(const FramePyramid& frame, const Vector6& twist_per_period,
                            const ShutterTimes& shutter, const Parameters& parameters) {
  twist_per_period_ = twist_per_period;
  shutter_ = shutter;
  contrast_in_view_ = frame.contrastInView();
  const int num_levels = frame.numLevels();
  levels_.resize(static_cast<std::size_t>(num_levels));
  frame.frame().image.copyTo(image_);
  depth_pyramid_.build(frame.frame(), num_levels, parameters.min_depth, parameters.max_depth,
                       parameters.depth_edge_ratio);
  for (int l = 0; l < num_levels; ++l) {
    std::vector<Pixel>& pixels = levels_[static_cast<std::size_t>(l)].points.pixels;
    const bool is_coarsest = l + 1 == num_levels && num_levels > 1;
    selectPoints(frame.grey(l), depth_pyramid_.level(l), is_coarsest, parameters, pixels);
    if (frame.isNormalised()) leaveOutSaturated(frame.grey(l), parameters.saturation, pixels);
  }
}

void Keyframe::choosePointsByDepth(const Parameters& parameters) {
  for (int l = 0; l < numLevels(); ++l) {
    std::vector<Pixel>& pixels = levels_[static_cast<std::size_t>(l)].points.pixels;
    if (static_cast<int>(pixels.size()) >= parameters.min_points) continue;
    selectEvenly(depth_pyramid_.level(l), parameters.min_points, pixels);
  }
}

void Keyframe::finish(const FramePyramid& frame, const Camera& camera,
                      const Parameters& parameters) {
  const RowMotion rows{twist_per_period_, shutter_.readout, 0.0};
  const RowMotion depth_rows{twist_per_period_, shutter_.readout, shutter_.depth_offset};
  for (int l = 0; l < numLevels(); ++l) {
    KeyframeLevel& level = levels_[static_cast<std::size_t>(l)];
    const bool uses_mi = usesMutualInformation(parameters, l);
    // Mutual information compares whole images, normalised beforehand; SSD normalises at its
    // points.
    const ReferenceImage image{
        uses_mi ? frame.informationImage(l) : frame.grey(l),
        !uses_mi && frame.isNormalised() ? &frame.contrast().level(l) : nullptr};
    level.points.level = l;
    makeReferencePoints(image, {depth_pyramid_.level(l), shutter_.depth_offset}, camera.atLevel(l),
                        rows, uses_mi, level.points);
    if (uses_mi) {
      makeMiReference(level.points, frame.informationRange(l), parameters, level.mi);
    }
  }
  if (!parameters.geometric_term) {
    geometric_points_ = GeometricPoints{};
    return;
  }
  // Level 1 has patches of the right size, 14 pixels of the image; level 0 where there is no other.
  const int l = std::min(1, numLevels() - 1);
  makeGeometricPoints(depth_pyramid_.level(l), camera.atLevel(l), depth_rows,
                      parameters.geometric_points, parameters.geometric_points_dark,
                      geometric_points_);
}

}  // namespace mivo
