// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/tracker.h"

#include "mivo/core/cpu_clock.h"
#include "mivo/core/mi_term.h"
#include "mivo/core/minimise.h"
#include "mivo/core/ssd_term.h"

namespace mivo {
namespace {

/// Minimises a term whose points are enough in view, and notes what happened.
template <typename Term>
bool alignLevel(Term& term, const ReferencePoints& points, const Parameters& parameters,
                Alignment& alignment, LevelRecord& record) {
  const auto needed = static_cast<std::size_t>(parameters.lost_points);
  if (points.size() < needed) return false;
  term.evaluate(alignment.T_live_ref);
  if (term.numVisible() < needed) return false;
  const Minimum minimum =
      minimise({&term}, alignment.T_live_ref, static_cast<double>(points.median_depth),
               points.pixel_motion, parameters);
  alignment.T_live_ref = minimum.T_live_ref;
  alignment.information = minimum.hessian;
  alignment.condition = minimum.condition;
  record.visible = static_cast<int>(term.numVisible());
  record.iterations = minimum.iterations;
  record.evaluations = minimum.evaluations;
  record.cost = minimum.cost / static_cast<double>(points.size());
  record.line_search_milliseconds = minimum.line_search_milliseconds;
  return true;
}

}  // namespace

Alignment align(const Keyframe& keyframe, const ImagePyramid& live, const Camera& camera,
                const Eigen::Isometry3d& T_live_ref_start, const Parameters& parameters) {
  Alignment alignment;
  alignment.T_live_ref = T_live_ref_start;
  for (int l = keyframe.numLevels() - 1; l >= 0; --l) {
    const double start = threadMilliseconds();
    const KeyframeLevel& level = keyframe.level(l);
    const Warp warp(camera.atLevel(l), parameters.threads);
    LevelRecord& record = alignment.levels[static_cast<std::size_t>(alignment.num_levels++)];
    record = LevelRecord{};
    record.level = l;
    record.points = static_cast<int>(level.points.size());
    record.mutual_information = usesMutualInformation(parameters, l);
    if (record.mutual_information) {
      MiTerm term(level.points, level.mi, live.level(l), warp, parameters);
      if (alignLevel(term, level.points, parameters, alignment, record)) {
        alignment.mutual_information = term.mutualInformation();
      }
    } else {
      SsdTerm term(level.points, live.level(l), warp, parameters);
      if (alignLevel(term, level.points, parameters, alignment, record)) {
        alignment.residual_scale = term.scale();
      }
    }
    record.milliseconds = threadMilliseconds() - start;
  }
  const LevelRecord& finest = alignment.levels[static_cast<std::size_t>(alignment.num_levels - 1)];
  alignment.points = finest.visible;
  alignment.overlap = finest.points > 0 ? static_cast<double>(finest.visible) / finest.points : 0.0;
  return alignment;
}

}  // namespace mivo
