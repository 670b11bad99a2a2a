// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/alignment/align.h"
#include "core/alignment/minimize.h"
#include "core/alignment/observability.h"
#include "core/execution/recycled.h"
#include "core/geometry/warp.h"
#include "core/terms/geometric_term.h"
#include "core/terms/mi_term.h"
#include "core/terms/motion_prior_term.h"
#include "core/terms/ssd_term.h"

namespace mivo {

/// Alignment on one level: warp, terms and their result.
class LevelAligner {
 public:
  /// Goes on from alignment.T_live_ref. Keeps references to all arguments.
  LevelAligner(const AlignmentTask& task, int level, const Parameters& parameters,
               Alignment& alignment, LevelRecord& record);

  void run();

  /// Curvature of this level's image term at the pose of the alignment, see confirm().
  TermCurvature imageCurvature();

 private:
  /// A level is minimized at once, or in two stages: the leading points, then all.
  enum class Stage { kOnly, kLeading, kLast };

  /// The terms of a level; null: not used.
  struct LevelTerms {
    CostTerm* image = nullptr;
    CostTerm* depth = nullptr;
    CostTerm* prior = nullptr;
    const SsdTerm* intensities = nullptr;  ///< the image's, if its residuals are gray levels
  };

  template <typename Term>
  bool isEnoughInView(Term& term) const;
  GeometricTerm* geometricTerm(int num_points);
  MotionPriorTerm* motionPrior(double weight);
  SsdTerm intensityTerm(std::size_t num_points) const;
  MiTerm miTerm() const;
  bool isRelated(const MiTerm& term) const;
  bool isRelated(const SsdTerm& term) const;

  void alignByMutualInformation();
  void alignBySsd();
  Stage alignLeadingPoints();
  void alignByDepthAlone(GeometricTerm& geometry);
  bool judgeDarkImageByDepth(SsdTerm& image, GeometricTerm& geometry,
                             const Eigen::Isometry3d& start);
  void judgeDepth(const GeometricTerm& geometry);
  Minimum minimumOfTerms(double tolerance, double trusted_step_pixels) const;
  void minimizeTerms(const LevelTerms& terms, Stage stage = Stage::kOnly);
  void holdOpenDirections(const SsdTerm* intensities, bool has_prior);
  void measureRows(SsdTerm& term, GeometricTerm* geometry);
  double toleranceOf(Stage stage) const;
  double share(std::size_t points) const;

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

}  // namespace mivo
