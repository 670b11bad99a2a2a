// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/tracker.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <initializer_list>
#include <optional>

#include "core/alignment/minimise.h"
#include "core/alignment/pose_covariance.h"
#include "core/execution/cpu_clock.h"
#include "core/execution/recycled.h"
#include "core/shutter/depth_offset_estimator.h"
#include "core/terms/geometric_term.h"
#include "core/terms/mi_term.h"
#include "core/terms/motion_prior_term.h"
#include "core/terms/ssd_term.h"

namespace mivo {
namespace {

// The shutter is measured where noise is already averaged, but rows still differ.
constexpr int kShutterLevel = 1;
// Neighbouring points say much the same: more of them do not make chance less likely.
constexpr int kIndependentPoints = 1500;
// Fewer blocks of the image say nothing about how much they err together.
constexpr int kMinBlocks = 15;
// What interpolation, blur and the keyframe's depth leave of systematic error, pixels: all points
// err alike, so that no residual shows it.
constexpr double kModelError = 0.05;
// Where few points have led the way all of them have one short step left, and need not try it.
constexpr double kLastTolerance = 4.0;

/// Motion of the scene per frame period in the axes of the live camera at a pose.
Vector6 twistPerPeriod(const AlignmentTask& task, const Eigen::Isometry3d& T_live_ref) {
  return localCoordinates(T_live_ref * task.T_previous_ref.inverse()) / task.periods;
}

/// One level of the descent: its warp, its terms, and what they found.
class LevelAligner {
 public:
  LevelAligner(const AlignmentTask& task, int level, const Parameters& parameters,
               Alignment& alignment, LevelRecord& record)
      : task_(task),
        level_(level),
        parameters_(parameters),
        points_(task.keyframe.level(level).points),
        rows_{twistPerPeriod(task, alignment.T_live_ref), task.shutter.readout, 0.0},
        warp_(task.camera.atLevel(level), rows_, parameters.alignment.threads),
        depth_warp_(task.camera, {rows_.twist, rows_.readout, task.shutter.depth_offset},
                    parameters.alignment.threads),
        alignment_(alignment),
        record_(record) {
    record_ = LevelRecord{};
    record_.level = level;
    record_.points = static_cast<int>(points_.size());
    record_.mutual_information = usesMutualInformation(parameters, level);
  }

  void run() {
    const double start = threadMilliseconds();
    if (record_.mutual_information) {
      alignByMutualInformation();
    } else {
      alignBySsd();
    }
    record_.milliseconds = threadMilliseconds() - start;
  }

 private:
  template <typename Term>
  bool isEnoughInView(Term& term) const {
    term.evaluate(alignment_.T_live_ref);  // always: the term is asked for its samples later
    return term.numVisible() >= static_cast<std::size_t>(parameters_.loss.lost_points);
  }

  /// The geometric term, if enough of its points have depth in the live frame.
  GeometricTerm* geometricTerm(int num_points) {
    const GeometricPoints& points = task_.keyframe.geometricPoints();
    if (!parameters_.geometry.geometric_term || points.size() == 0) return nullptr;
    geometry_.emplace(points, static_cast<std::size_t>(num_points), task_.live, depth_warp_,
                      parameters_);
    geometry_->evaluate(alignment_.T_live_ref);
    if (geometry_->numVisible() < static_cast<std::size_t>(parameters_.loss.lost_points))
      return nullptr;
    return &*geometry_;
  }

  /// Where depth alone is to tell the pose: what keeps it from sliding along walls. None when
  /// nothing is known about the motion.
  MotionPriorTerm* motionPrior(GeometricTerm* geometry) {
    const MotionUncertainty& uncertainty = task_.uncertainty;
    if (geometry == nullptr || !(uncertainty.translation > 0.0 && uncertainty.rotation > 0.0)) {
      return nullptr;
    }
    prior_.emplace(task_.T_live_ref, uncertainty, correlationFactor(*geometry));
    return &*prior_;
  }

  /// How many times a term counts what it knows: the covariance of its gradient would be its
  /// Hessian if its residuals were independent.
  double correlationFactor(GeometricTerm& term) const {
    Matrix6 of_gradient;
    if (term.gradientCovariance(of_gradient) < kMinBlocks) return 1.0;
    const Matrix6 hessian = term.linearise(0).hessian;
    const Matrix6 ratio = hessian.ldlt().solve(of_gradient);
    return std::max(1.0, ratio.trace() / 6.0);
  }

  /// Whether a level is one descent, or two of them: some points lead, all of them come last.
  enum class Stage { kOnly, kLeading, kLast };

  /// Levels whose result is kept are finished with care.
  double toleranceOf(Stage stage) const {
    if (stage == Stage::kLast) return kLastTolerance;
    return level_ > kShutterLevel ? parameters_.alignment.coarse_tolerance : 1.0;
  }

  /// Minimises the sum of the terms that there are.
  void minimiseTerms(std::initializer_list<CostTerm*> terms, Stage stage = Stage::kOnly) {
    terms_->clear();
    for (CostTerm* term : terms) {
      if (term != nullptr) terms_->push_back(term);
    }
    if (terms_->empty()) return;
    const double tolerance = toleranceOf(stage);
    // Mutual information is rugged near its maximum. Where no SSD follows that mends it, no step
    // goes untried.
    const double trusted = parameters_.alignment.method == Method::kMi
                               ? 0.0
                               : tolerance * parameters_.alignment.trusted_step_pixels;
    const Minimum minimum =
        minimise(*terms_, alignment_.T_live_ref, static_cast<double>(points_.median_depth),
                 points_.pixel_motion, parameters_, tolerance, trusted);
    alignment_.T_live_ref = minimum.T_live_ref;
    alignment_.hessian = minimum.hessian;
    alignment_.condition = minimum.condition;
    if (level_ == 0 && stage != Stage::kLeading) estimateCovariance(*terms_);
    record_.iterations += minimum.iterations;
    record_.evaluations += minimum.evaluations;
    record_.cost = minimum.cost / static_cast<double>(std::max<std::size_t>(1, points_.size()));
    record_.line_search_milliseconds += minimum.line_search_milliseconds;
  }

  /// H⁻¹ C H⁻¹ with the covariance C of the gradient. Residuals that were independent would make C
  /// equal to H; they are not, and H⁻¹ alone would promise several times too much.
  void estimateCovariance(const std::vector<CostTerm*>& terms) {
    Matrix6 of_gradient = Matrix6::Zero();
    int blocks = 0;
    for (const CostTerm* term : terms) {
      Matrix6 part;
      blocks = std::max(blocks, term->gradientCovariance(part));
      of_gradient += part;
    }
    const Matrix6 inverse = alignment_.hessian.ldlt().solve(Matrix6(Matrix6::Identity()));
    alignment_.covariance = inverse;
    if (blocks >= kMinBlocks) {
      // Six directions have been fitted to the blocks.
      const double fitted = static_cast<double>(blocks) / (blocks - 6.0);
      alignment_.covariance = fitted * inverse * of_gradient * inverse.transpose();
    }
    const double angle = kModelError / warp_.camera().fx;
    alignment_.covariance +=
        diagonalCovariance(angle * static_cast<double>(points_.median_depth), angle);
  }

  double share(std::size_t points) const {
    return points_.size() > 0 ? static_cast<double>(points) / static_cast<double>(points_.size())
                              : 0.0;
  }

  void judgeDepth(const GeometricTerm& geometry) {
    alignment_.depth_scale = geometry.scale();
    alignment_.sees_depth = geometry.scale() <= parameters_.loss.lost_depth_scale;
  }

  void alignByMutualInformation() {
    MiTerm term(points_, task_.keyframe.level(level_).mi, task_.live.miImage(level_),
                task_.live.miRange(level_), warp_, parameters_);
    const Eigen::Isometry3d start = alignment_.T_live_ref;
    alignment_.sees_image = false;
    alignment_.sees_depth = false;
    if (isEnoughInView(term)) {
      minimiseTerms({&term});
      record_.visible = static_cast<int>(term.numVisible());
      alignment_.overlap = share(term.numVisible());
      alignment_.mutual_information = term.mutualInformation();
      alignment_.sees_image =
          2.0 * std::min(record_.visible, kIndependentPoints) * term.mutualInformation() >=
          parameters_.mi.mi_significance;
    }
    if (alignment_.sees_image) return;
    // Chance, not structure: its maximum means nothing. Depth may still know the way.
    alignment_.T_live_ref = start;
    if (GeometricTerm* geometry = geometricTerm(parameters_.geometry.geometric_points_dark)) {
      minimiseTerms({geometry, motionPrior(geometry)});
      judgeDepth(*geometry);
    }
  }

  SsdTerm intensityTerm(std::size_t num_points) const {
    return SsdTerm(points_, num_points, task_.live.grey(level_),
                   task_.live.isNormalised() ? &task_.live.contrast().level(level_) : nullptr,
                   warp_, parameters_);
  }

  /// The iterations are done with few points, if they see enough. Returns what is left to do.
  Stage alignLeadingPoints() {
    if (points_.num_leading == points_.size() || alignment_.isDepthOnly()) return Stage::kOnly;
    SsdTerm term = intensityTerm(points_.num_leading);
    if (!isEnoughInView(term) || !term.isSignificant()) return Stage::kOnly;
    minimiseTerms({&term, geometricTerm(parameters_.geometry.geometric_points)}, Stage::kLeading);
    return Stage::kLast;
  }

  void alignBySsd() {
    const Stage stage = alignLeadingPoints();
    SsdTerm term = intensityTerm(points_.size());
    alignment_.sees_image = isEnoughInView(term) && term.isSignificant();
    const bool shows_enough = alignment_.sees_image && !alignment_.isDepthOnly();
    GeometricTerm* geometry =
        geometricTerm(shows_enough ? parameters_.geometry.geometric_points
                                   : parameters_.geometry.geometric_points_dark);
    const bool has_points =
        term.numVisible() >= static_cast<std::size_t>(parameters_.loss.lost_points);
    alignment_.sees_depth = false;
    minimiseTerms({has_points ? &term : nullptr, geometry,
                   alignment_.sees_image ? nullptr : motionPrior(geometry)},
                  stage);
    if (geometry != nullptr) judgeDepth(*geometry);
    record_.visible = static_cast<int>(term.numVisible());
    alignment_.overlap = share(term.numInView());
    alignment_.residual_scale = term.scale();
    alignment_.correlation = term.correlation();
    alignment_.sees_image = alignment_.sees_image && term.isInformative() &&
                            alignment_.correlation >= parameters_.loss.lost_correlation;
    if (level_ == kShutterLevel && alignment_.sees_image) measureShutter(term, geometry);
  }

  void measureShutter(SsdTerm& term, GeometricTerm* geometry) {
    RowVelocities velocities;
    velocities.live = twistPerPeriod(task_, alignment_.T_live_ref);
    velocities.keyframe = task_.keyframe.twistPerPeriod();
    velocities.T_live_ref = alignment_.T_live_ref;
    if (parameters_.shutter.rolling_shutter_estimation &&
        parameters_.shutter.rolling_shutter_readout == 0.0) {
      alignment_.readout = measureReadout(points_, term.residuals(), term.samples().v,
                                          warp_.camera().height, term.scale(), velocities);
    }
    if (parameters_.shutter.depth_time_offset_estimation && geometry != nullptr) {
      // The two stand at one pose, be it a step before the last: the measurement allows for that.
      const auto median_depth = static_cast<double>(points_.median_depth);
      alignment_.depth_offset =
          measureDepthOffset(modelOf(term), modelOf(*geometry), velocities, median_depth);
    }
  }

  TermModel modelOf(CostTerm& term) const {
    TermModel result;
    result.model = term.linearise(parameters_.ssd.robust_scale_iterations);  // keeps its scale
    if (term.gradientCovariance(result.gradient_covariance) < kMinBlocks) {
      result.gradient_covariance = result.model.hessian;
    }
    return result;
  }

  const AlignmentTask& task_;
  int level_;
  const Parameters& parameters_;
  const ReferencePoints& points_;
  RowMotion rows_;
  Warp warp_;
  Warp depth_warp_;
  Alignment& alignment_;
  LevelRecord& record_;
  std::optional<GeometricTerm> geometry_;
  std::optional<MotionPriorTerm> prior_;
  Recycled<std::vector<CostTerm*>> terms_;
};

}  // namespace

Alignment align(const AlignmentTask& task, const Parameters& parameters) {
  Alignment alignment;
  alignment.T_live_ref = task.T_live_ref;
  const double of_keyframe = task.keyframe.contrastInView();
  const double least =
      parameters.loss.blind_contrast * std::max(of_keyframe, task.last_lit_contrast);
  alignment.is_keyframe_dark = of_keyframe < least;
  alignment.is_live_dark = task.live.contrastInView() < least;
  for (int l = task.keyframe.numLevels() - 1; l >= 0; --l) {
    LevelRecord& record = alignment.levels[static_cast<std::size_t>(alignment.num_levels++)];
    LevelAligner(task, l, parameters, alignment, record).run();
  }
  const LevelRecord& finest = alignment.levels[static_cast<std::size_t>(alignment.num_levels - 1)];
  alignment.points = finest.visible;
  return alignment;
}

}  // namespace mivo
