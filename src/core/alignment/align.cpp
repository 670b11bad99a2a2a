// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/align.h"

#include <algorithm>

#include "core/alignment/level_aligner.h"
#include "core/alignment/pose_covariance.h"

namespace mivo {
namespace {

// Gray levels: less contrast on the coarsest level is only noise.
constexpr double kLeastContrast = 1.0;

/// Whether both images have enough contrast, relative to the last view with enough.
void judgeContrast(const AlignmentTask& task, const Parameters& parameters, Alignment& alignment) {
  const double of_keyframe = task.keyframe.contrastInView();
  const double least = std::max(kLeastContrast, parameters.loss.blind_contrast *
                                                    std::max(of_keyframe, task.last_lit_contrast));
  alignment.is_keyframe_dark = of_keyframe < least;
  alignment.is_live_dark = task.live.contrastInView() < least;
}

}  // namespace

Matrix6 PoseExpectation::incrementCovariance() const {
  if (!is_known) return guessCovariance();
  const Matrix6 to_increment = adjoint(T_live_ref.inverse());
  const Matrix6 before = to_increment * (covariance - drift) * to_increment.transpose();
  return positivePart(before - keyframe_covariance) +
         to_increment * drift * to_increment.transpose();
}

Matrix6 PoseExpectation::cameraCovariance() const {
  const Matrix6 to_camera = adjoint(T_live_ref);
  return to_camera * incrementCovariance() * to_camera.transpose();
}

Alignment align(const AlignmentTask& task, const Parameters& parameters) {
  Alignment alignment;
  alignment.T_live_ref = task.T_live_ref;
  judgeContrast(task, parameters, alignment);
  const int coarsest = std::max(0, task.keyframe.numLevels() - 1 - task.skipped_levels);
  for (int l = coarsest; l >= 0; --l) {
    LevelRecord& record = alignment.levels[static_cast<std::size_t>(alignment.num_levels++)];
    LevelAligner(task, l, parameters, alignment, record).run();
  }
  const LevelRecord& finest = alignment.levels[static_cast<std::size_t>(alignment.num_levels - 1)];
  alignment.points = finest.visible;
  return alignment;
}

}  // namespace mivo
