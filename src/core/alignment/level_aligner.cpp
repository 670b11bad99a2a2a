// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/level_aligner.h"

#include <algorithm>

#include "core/alignment/open_directions.h"
#include "core/execution/cpu_clock.h"
#include "core/shutter/shutter_measurement.h"
#include "core/terms/mi_evidence.h"

namespace mivo {
namespace {

// The shutter is measured on this level: noise is averaged, but rows still differ.
constexpr int kShutterLevel = 1;
// Errors by light, blur and depth are correlated between pixels: mutual information is
// overconfident by about this factor.
constexpr double kMiCountsTimes = 8.0;
// Gradients caused by noise, gray levels per pixel. For a smoothed image: a quarter of its noise,
// up to four times that at points selected for strong gradients, and at least that of rounding and
// compression. For an unsmoothed image: about the second value.
constexpr double kLeastNoiseGradient = 1.0;
constexpr double kUsualNoiseGradient = 4.0;
// After the leading points have converged, one short step with all points remains, which needs no
// line search.
constexpr double kLastTolerance = 4.0;

/// Motion of the scene per frame period in the axes of the live camera at a pose.
Vector6 twistPerPeriod(const AlignmentTask& task, const Eigen::Isometry3d& T_live_ref) {
  return localCoordinates(T_live_ref * task.motion.T_previous_ref.inverse()) / task.motion.periods;
}

}  // namespace

LevelAligner::LevelAligner(const AlignmentTask& task, int level, const Parameters& parameters,
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

void LevelAligner::run() {
  const double start = threadMilliseconds();
  if (record_.mutual_information) {
    alignByMutualInformation();
  } else {
    alignBySsd();
  }
  record_.milliseconds = threadMilliseconds() - start;
}

template <typename Term>
bool LevelAligner::isEnoughInView(Term& term) const {
  term.evaluate(alignment_.T_live_ref);  // always evaluated: its samples are used later
  return term.numVisible() >= static_cast<std::size_t>(parameters_.loss.lost_points);
}

/// Prior at the predicted pose; null when there is no prediction.
MotionPriorTerm* LevelAligner::motionPrior(double weight) {
  const PoseExpectation& expected = task_.expected;
  if (!expected.is_known) return nullptr;
  prior_.emplace(expected.T_live_ref, expected.cameraCovariance(), weight);
  return &*prior_;
}

/// Levels that determine the result use the full tolerance.
double LevelAligner::toleranceOf(Stage stage) const {
  if (stage == Stage::kLast) return kLastTolerance;
  return level_ > kShutterLevel ? parameters_.alignment.coarse_tolerance : 1.0;
}

Minimum LevelAligner::minimumOfTerms(double tolerance, double trusted_step_pixels) const {
  return minimize(*terms_, alignment_.T_live_ref, static_cast<double>(points_.median_depth),
                  points_.pixel_motion, parameters_, tolerance, trusted_step_pixels);
}

/// Minimizes the sum of the terms that there are.
void LevelAligner::minimizeTerms(const LevelTerms& terms, Stage stage) {
  terms_->clear();
  for (CostTerm* term : {terms.image, terms.depth}) {
    if (term != nullptr) terms_->push_back(term);
  }
  if (terms_->empty()) return;
  const std::size_t num_measuring = terms_->size();
  if (terms.prior != nullptr) terms_->push_back(terms.prior);
  const double tolerance = toleranceOf(stage);
  // Mutual information is rugged near its maximum. Without SSD on finer levels, every step is
  // tested by the line search.
  const double trusted = parameters_.alignment.method == Method::kMi
                             ? 0.0
                             : tolerance * parameters_.alignment.trusted_step_pixels;
  const Minimum minimum = minimumOfTerms(tolerance, trusted);
  alignment_.T_live_ref = minimum.T_live_ref;
  alignment_.hessian = minimum.hessian;
  record_.iterations += minimum.iterations;
  record_.evaluations += minimum.evaluations;
  record_.cost = minimum.cost / static_cast<double>(std::max<std::size_t>(1, points_.size()));
  record_.line_search_milliseconds += minimum.line_search_milliseconds;
  if (level_ == 0 && stage != Stage::kLeading) {
    terms_->resize(num_measuring);
    holdOpenDirections(terms.intensities, terms.prior != nullptr);
  }
}

void LevelAligner::holdOpenDirections(const SsdTerm* intensities, bool has_prior) {
  const auto add_coarser = [&](const Eigen::Isometry3d& T_live_ref,
                               std::vector<TermCurvature>& curvatures) {
    Alignment there = alignment_;
    there.T_live_ref = T_live_ref;
    LevelRecord record;
    for (int l = 1; l <= std::min(kCoarsestAskedLevel, task_.keyframe.numLevels() - 1); ++l) {
      curvatures.push_back(LevelAligner(task_, l, parameters_, there, record).imageCurvature());
    }
  };
  const double noise_gradient = task_.live.isNormalized()
                                    ? std::max(kLeastNoiseGradient, task_.live.contrast().noise())
                                    : kUsualNoiseGradient;
  mivo::holdOpenDirections({*terms_, has_prior, intensities, points_, warp_.camera(), add_coarser,
                            task_.expected, noise_gradient},
                           parameters_, alignment_);
}

TermCurvature LevelAligner::imageCurvature() {
  const auto curvatureOf = [&](CostTerm& term) {
    return TermCurvature{term.linearize(kScaleIsKept).hessian, term.agreement(points_.size()),
                         kLeastAgreementAbove};
  };
  if (record_.mutual_information) {
    MiTerm term = miTerm();
    return isEnoughInView(term) && isRelated(term) ? curvatureOf(term) : TermCurvature{};
  }
  SsdTerm term = intensityTerm(points_.size());
  return isEnoughInView(term) && isRelated(term) ? curvatureOf(term) : TermCurvature{};
}

MiTerm LevelAligner::miTerm() const {
  return MiTerm(points_, task_.keyframe.level(level_).mi, task_.live.miImage(level_),
                task_.live.miRange(level_), warp_, parameters_);
}

/// Whether the images have something in common at the term's pose.
bool LevelAligner::isRelated(const MiTerm& term) const {
  const MiEvidence evidence =
      miEvidence(term.mutualInformation(), term.numVisible(), parameters_.mi.mi_bins);
  return evidence.deviations >= parameters_.mi.mi_significance;
}

bool LevelAligner::isRelated(const SsdTerm& term) const {
  return term.isSignificant() && term.correlation() >= parameters_.loss.lost_correlation;
}

double LevelAligner::share(std::size_t points) const {
  return points_.size() > 0 ? static_cast<double>(points) / static_cast<double>(points_.size())
                            : 0.0;
}

void LevelAligner::alignByMutualInformation() {
  MiTerm term = miTerm();
  const Eigen::Isometry3d start = alignment_.T_live_ref;
  alignment_.sees_image = false;
  alignment_.sees_depth = false;
  if (isEnoughInView(term)) {
    LevelTerms terms;
    terms.image = &term;
    if (task_.holds_coarse_levels && level_ > 0) terms.prior = motionPrior(kMiCountsTimes);
    minimizeTerms(terms);
    record_.visible = static_cast<int>(term.numVisible());
    alignment_.overlap = share(term.numVisible());
    alignment_.mutual_information = term.mutualInformation();
    alignment_.correlation =
        miEvidence(term.mutualInformation(), term.numVisible(), parameters_.mi.mi_bins).correlation;
    // On level 0, where the result decides about the frame, it is judged like SSD.
    const bool is_strong =
        level_ > 0 || alignment_.correlation >= parameters_.loss.lost_correlation;
    alignment_.sees_image = is_strong && isRelated(term);
  }
  if (alignment_.sees_image) return;
  // Not significant: the maximum is meaningless. Depth alone may still determine the pose.
  alignment_.T_live_ref = start;
  if (GeometricTerm* geometry = geometricTerm(parameters_.geometry.geometric_points_dark)) {
    alignByDepthAlone(*geometry);
  }
}

SsdTerm LevelAligner::intensityTerm(std::size_t num_points) const {
  return SsdTerm(points_, num_points, task_.live.gray(level_),
                 task_.live.isNormalized() ? &task_.live.contrast().level(level_) : nullptr, warp_,
                 parameters_);
}

/// Iterates with the leading points, if enough are in view. Returns the remaining stage.
LevelAligner::Stage LevelAligner::alignLeadingPoints() {
  if (points_.num_leading == points_.size() || alignment_.isDepthOnly()) return Stage::kOnly;
  SsdTerm term = intensityTerm(points_.num_leading);
  if (!isEnoughInView(term) || !term.isSignificant()) return Stage::kOnly;
  LevelTerms terms;
  terms.image = &term;
  terms.depth = geometricTerm(parameters_.geometry.geometric_points);
  minimizeTerms(terms, Stage::kLeading);
  return Stage::kLast;
}

void LevelAligner::alignBySsd() {
  const Eigen::Isometry3d start = alignment_.T_live_ref;
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
  LevelTerms terms;
  if (has_points) {
    terms.image = &term;
    terms.intensities = &term;
  }
  terms.depth = geometry;
  if (!alignment_.sees_image && geometry != nullptr)
    terms.prior = motionPrior(geometry->overconfidence());
  minimizeTerms(terms, stage);
  if (geometry != nullptr) judgeDepth(*geometry);
  if (alignment_.sees_image && !shows_enough && alignment_.has_open_directions &&
      geometry != nullptr) {
    alignment_.sees_image = !judgeDarkImageByDepth(term, *geometry, start);
    term.evaluate(alignment_.T_live_ref);
  }
  // If the image shows nothing, or only white, the points of the depth term count.
  record_.visible = static_cast<int>(alignment_.sees_image || geometry == nullptr
                                         ? term.numVisible()
                                         : std::max(term.numVisible(), geometry->numVisible()));
  alignment_.overlap = share(term.numInView());
  alignment_.residual_scale = term.scale();
  alignment_.correlation = term.correlation();
  alignment_.sees_image = alignment_.sees_image && term.isInformative() && isRelated(term);
  if (level_ == kShutterLevel && alignment_.sees_image) measureRows(term, geometry);
}

void LevelAligner::measureRows(SsdTerm& term, GeometricTerm* geometry) {
  RowVelocities velocities;
  velocities.live = twistPerPeriod(task_, alignment_.T_live_ref);
  velocities.keyframe = task_.keyframe.twistPerPeriod();
  velocities.T_live_ref = alignment_.T_live_ref;
  const ShutterMeasurement measured =
      measureShutter(points_, term, geometry, warp_.camera().height, velocities, parameters_);
  alignment_.readout = measured.readout;
  alignment_.depth_offset = measured.depth_offset;
}

}  // namespace mivo
