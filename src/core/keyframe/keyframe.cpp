// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/keyframe.h"

#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

/// @param fraction of the pixels to select, if larger than point_fraction.
void selectPoints(const cv::Mat& image, const cv::Mat& depth, bool is_coarsest, double fraction,
                  const Parameters& parameters, ReferencePoints& points) {
  if (is_coarsest || parameters.points.point_fraction == 1.0) {
    selectAll(depth, points.pixels);
    points.num_leading = points.size();
    return;
  }
  const auto numPoints = [&](double share) {
    const double wanted = share * static_cast<double>(image.total());
    return std::max(parameters.points.min_points, static_cast<int>(std::lround(wanted)));
  };
  SelectionLimits limits{};
  limits.num_leading = numPoints(parameters.points.point_fraction);
  limits.num_points = std::max(limits.num_leading, numPoints(fraction));
  limits.min_gradient = static_cast<float>(parameters.points.min_gradient);
  limits.cell_size = parameters.points.point_cell_size;
  limits.depth_edge_ratio = static_cast<float>(parameters.depth.depth_edge_ratio);
  points.num_leading = selectSalient(image, depth, limits, points.pixels);
}

/// Keeps the pixels that `is_kept` is true for.
template <typename Condition>
void keepPixels(const Condition& is_kept, ReferencePoints& points) {
  std::size_t count = 0;
  std::size_t num_leading = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Pixel pixel = points.pixels[i];
    const std::size_t one = is_kept(pixel) ? 1U : 0U;  // no branch: it would be unpredictable
    points.pixels[count] = pixel;
    count += one;
    num_leading += i < points.num_leading ? one : 0U;
  }
  points.pixels.resize(count);
  points.num_leading = num_leading;
}

template <typename Value>
void leaveOutAbove(const cv::Mat& image, Value limit, ReferencePoints& points) {
  const auto stride = static_cast<std::ptrdiff_t>(image.step1());
  const auto isBelow = [&](const Pixel& pixel) {
    const Value* row = image.ptr<Value>(pixel.y) + pixel.x - stride;
    Value highest = row[0];
    for (int y = 0; y < 3; ++y, row += stride) {
      highest = std::max({highest, row[-1], row[0], row[1]});
    }
    return highest < limit;
  };
  keepPixels(isBelow, points);
}

/// Pixels with a possibly clipped neighbor: their gradient is not that of the scene.
void leaveOutSaturated(const cv::Mat& image, double saturation, ReferencePoints& points) {
  if (image.type() == CV_8UC1) {
    // For integers, the limit is rounded up.
    const double limit = std::ceil(saturation);
    if (limit <= 255.0) leaveOutAbove(image, static_cast<unsigned char>(limit), points);
  } else {
    leaveOutAbove(image, static_cast<float>(saturation), points);
  }
}

/// Pixels without a ray, in the corners of an image whose lens' polynomial folds back there.
void leaveOutOfLens(const Camera& camera, ReferencePoints& points) {
  const LensRange range = camera.lensRange();
  const double right = camera.width - 1.0;
  const double bottom = camera.height - 1.0;
  const auto hasRay = [&](double x, double y) { return camera.hasRay({x, y}, range); };
  if (hasRay(0.0, 0.0) && hasRay(right, 0.0) && hasRay(0.0, bottom) && hasRay(right, bottom)) {
    return;  // the usual case
  }
  keepPixels([&](const Pixel& pixel) { return hasRay(pixel.x, pixel.y); }, points);
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
  depth_pyramid_.build(frame.frame(), num_levels, parameters.depth.min_depth,
                       parameters.depth.max_depth, parameters.depth.depth_edge_ratio);
  for (int l = 0; l < num_levels; ++l) {
    ReferencePoints& points = levels_[static_cast<std::size_t>(l)].points;
    const bool is_coarsest = l + 1 == num_levels && num_levels > 1;
    const bool is_finest = l == 0 && frame.isNormalized() && !usesMutualInformation(parameters, l);
    selectPoints(frame.gray(l), depth_pyramid_.level(l), is_coarsest,
                 is_finest ? parameters.points.finest_point_fraction : 0.0, parameters, points);
    if (frame.isNormalized())
      leaveOutSaturated(frame.gray(l), parameters.alignment.saturation, points);
  }
}

void Keyframe::choosePointsByDepth(double last_lit_contrast, const Parameters& parameters) {
  const bool shows_little = last_lit_contrast > contrast_in_view_ ||
                            static_cast<int>(numPoints()) < parameters.loss.lost_points;
  if (!shows_little) return;
  for (int l = 0; l < numLevels(); ++l) {
    ReferencePoints& points = levels_[static_cast<std::size_t>(l)].points;
    if (static_cast<int>(points.size()) >= parameters.points.min_points) continue;
    selectEvenly(depth_pyramid_.level(l), parameters.points.min_points, points.pixels);
    points.num_leading = points.size();
  }
}

void Keyframe::finish(const FramePyramid& frame, const Camera& camera,
                      const Parameters& parameters) {
  const RowMotion rows{twist_per_period_, shutter_.readout, 0.0};
  const RowMotion depth_rows{twist_per_period_, shutter_.readout, shutter_.depth_offset};
  for (int l = 0; l < numLevels(); ++l) {
    KeyframeLevel& level = levels_[static_cast<std::size_t>(l)];
    const bool uses_mi = usesMutualInformation(parameters, l);
    // Mutual information compares whole images, normalized beforehand; SSD normalizes at its
    // points.
    const ReferenceImage image{
        uses_mi ? frame.miImage(l) : frame.gray(l),
        !uses_mi && frame.isNormalized() ? &frame.contrast().level(l) : nullptr};
    const Camera level_camera = camera.atLevel(l);
    level.points.level = l;
    leaveOutOfLens(level_camera, level.points);
    makeReferencePoints(image, {depth_pyramid_.level(l), shutter_.depth_offset}, level_camera, rows,
                        uses_mi, level.points);
    if (uses_mi) {
      makeMiReference(level.points, frame.miRange(l), parameters, level.mi);
    }
  }
  if (!parameters.geometry.geometric_term) {
    geometric_points_ = GeometricPoints{};
    return;
  }
  // Level 1 has patches of the right size, 14 pixels of the image; level 0 where there is no other.
  const int l = std::min(1, numLevels() - 1);
  makeGeometricPoints(depth_pyramid_.level(l), camera.atLevel(l), depth_rows,
                      parameters.geometry.geometric_points,
                      parameters.geometry.geometric_points_dark, geometric_points_);
}

}  // namespace mivo
