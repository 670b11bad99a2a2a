// SPDX-License-Identifier: BSD-3-Clause
// The part of LevelAligner that depth determines.
#include "core/alignment/level_aligner.h"

namespace mivo {

/// The geometric term, if enough of its points have depth in the live frame.
GeometricTerm* LevelAligner::geometricTerm(int num_points) {
  const GeometricPoints& points = task_.keyframe.geometricPoints();
  if (!parameters_.geometry.geometric_term || points.size() == 0) return nullptr;
  geometry_.emplace(points, static_cast<std::size_t>(num_points), task_.live, depth_warp_,
                    parameters_);
  geometry_->evaluate(alignment_.T_live_ref);
  if (geometry_->numVisible() < static_cast<std::size_t>(parameters_.loss.lost_points)) {
    return nullptr;
  }
  return &*geometry_;
}

void LevelAligner::judgeDepth(const GeometricTerm& geometry) {
  alignment_.depth_scale = geometry.scale();
  alignment_.sees_depth = geometry.scale() <= parameters_.loss.lost_depth_scale;
}

void LevelAligner::alignByDepthAlone(GeometricTerm& geometry) {
  LevelTerms terms;
  terms.depth = &geometry;
  terms.prior = motionPrior(geometry.overconfidence());
  minimizeTerms(terms);
  judgeDepth(geometry);
}

/// A dark image is mostly noise: of its curvature hardly anything is confirmed, and it leaves
/// directions open that depth alone sees. If depth alone sees all of them, its covariance counts
/// and the image only refines the pose. Otherwise nothing is changed, and the result is false.
bool LevelAligner::judgeDarkImageByDepth(SsdTerm& image, GeometricTerm& geometry,
                                         const Eigen::Isometry3d& start) {
  const Alignment with_image = alignment_;
  alignment_.T_live_ref = start;
  alignByDepthAlone(geometry);
  if (alignment_.has_open_directions) {
    alignment_ = with_image;
    return false;
  }
  terms_->assign({&image, &geometry});
  alignment_.T_live_ref = minimumOfTerms(1.0, parameters_.alignment.trusted_step_pixels).T_live_ref;
  return true;
}

}  // namespace mivo
