// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/keyframe.h"

#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

std::vector<Pixel> selectPoints(const cv::Mat& image, const cv::Mat& depth, bool is_coarsest,
                                const Parameters& parameters) {
  const auto edge_ratio = static_cast<float>(parameters.depth_edge_ratio);
  if (is_coarsest) return selectAll(depth, edge_ratio);
  const double wanted = parameters.point_fraction * static_cast<double>(image.total());
  SelectionLimits limits{};
  limits.num_points = std::max(parameters.min_points, static_cast<int>(std::lround(wanted)));
  limits.min_gradient = static_cast<float>(parameters.min_gradient);
  limits.cell_size = parameters.point_cell_size;
  limits.depth_edge_ratio = edge_ratio;
  return selectSalient(image, depth, limits);
}

}  // namespace

bool usesMutualInformation(const Parameters& parameters, int level) {
  return parameters.method == Method::kMi ||
         (parameters.method == Method::kHybrid && level >= parameters.switch_level);
}

void Keyframe::build(const ImagePyramid& pyramid, const Frame& frame, const Camera& camera,
                     const Parameters& parameters) {
  const int num_levels = pyramid.numLevels();
  levels_.resize(static_cast<std::size_t>(num_levels));
  frame.image.copyTo(image_);
  depth_pyramid_.build(frame, num_levels, parameters.min_depth, parameters.max_depth,
                       parameters.depth_edge_ratio);
  for (int l = 0; l < num_levels; ++l) {
    KeyframeLevel& level = levels_[static_cast<std::size_t>(l)];
    const cv::Mat& image = pyramid.level(l);
    const cv::Mat& depth = depth_pyramid_.level(l);
    const bool is_coarsest = l + 1 == num_levels && num_levels > 1;
    const bool uses_mi = usesMutualInformation(parameters, l);
    level.points.level = l;
    makeReferencePoints(image, depth, camera.atLevel(l),
                        selectPoints(image, depth, is_coarsest, parameters), uses_mi, level.points);
    if (uses_mi) level.mi = makeMiReference(level.points, image, parameters);
  }
}

}  // namespace mivo
