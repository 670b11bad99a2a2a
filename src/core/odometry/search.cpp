// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/search.h"

#include <optional>

#include "core/odometry/hypotheses.h"
#include "core/odometry/judgment.h"
#include "core/odometry/recovery.h"

namespace mivo {
namespace {

/// For a keyframe of another segment there is no prediction: zero velocity, unknown pose.
AlignmentTask taskFor(const SearchInput& input, const Prediction& prediction,
                      const PosedKeyframe& keyframe, const RecoveryAttempt& attempt) {
  const bool is_connected = keyframe.segment == input.state.segment;
  AlignmentTask task{keyframe.keyframe, input.live, input.camera};
  task.T_live_ref = attempt.T_odom_camera.inverse() * keyframe.T_odom_keyframe;
  task.motion.T_previous_ref = is_connected
                                   ? input.state.T_odom_camera.inverse() * keyframe.T_odom_keyframe
                                   : task.T_live_ref;
  task.motion.periods = prediction.periods;
  task.shutter = input.state.shutter_times;
  task.last_lit_contrast = keyframe.last_lit_contrast;
  task.expected.is_known = is_connected;
  task.expected.T_live_ref = prediction.T_odom_camera.inverse() * keyframe.T_odom_keyframe;
  task.expected.covariance = prediction.covariance;
  task.expected.drift = prediction.drift;
  task.expected.keyframe_covariance = keyframe.covariance;
  task.skipped_levels = attempt.skipped_levels;
  task.holds_coarse_levels = is_connected && attempt.is_expected &&
                             input.state.motion.hasVelocity() &&
                             input.parameters.motion.hold_coarse_levels;
  return task;
}

/// Within one segment the motion since the last frame is checked as well.
TrackingReason judgeSight(const SearchInput& input, const Prediction& prediction,
                          const PosedKeyframe& keyframe, const Alignment& alignment) {
  const TrackingReason reason = judge(alignment, input.parameters.loss);
  if (reason != TrackingReason::kNone || keyframe.segment != input.state.segment) return reason;
  const Vector6 motion =
      localCoordinates(input.state.T_odom_camera.inverse() * keyframe.T_odom_keyframe *
                       alignment.T_live_ref.inverse());
  return judgeMotion(motion, prediction.seconds, input.parameters.loss);
}

Sight look(const SearchInput& input, const Prediction& prediction, const RecoveryAttempt& attempt) {
  const PosedKeyframe& keyframe = input.keyframes.at(attempt.keyframe);
  Sight sight;
  sight.keyframe = attempt.keyframe;
  sight.alignment = align(taskFor(input, prediction, keyframe, attempt), input.parameters);
  sight.reason = judgeSight(input, prediction, keyframe, sight.alignment);
  return sight;
}

bool isBelievable(const Sight& sight) {
  return sight.reason == TrackingReason::kNone;
}

/// The first recovery attempt with a result that is acceptable without a prediction.
std::optional<Sight> recover(const SearchInput& input, const Prediction& prediction) {
  const OdometryState& state = input.state;
  for (const RecoveryAttempt& attempt : recoveryAttempts(
           input.keyframes, state.T_odom_camera, prediction.T_odom_camera, state.lost_in_a_row)) {
    const Sight sight = look(input, prediction, attempt);
    if (isBelievable(sight) && isConvincing(sight.alignment, input.parameters.loss) &&
        !sight.alignment.has_open_directions) {
      return sight;
    }
  }
  return std::nullopt;
}

/// A sight that hardly agrees with the keyframe, or that the motion so far did not lead to.
bool isDoubtful(const SearchInput& input, const Prediction& prediction, const Sight& sight) {
  if (!isConvincing(sight.alignment, input.parameters.loss)) return true;
  const double bound = input.parameters.loss.surprise_deviations;
  return input.state.motion.hasVelocity() && innovation(input, prediction, sight) > bound * bound;
}

/// How many of the coarsest levels are aligned by mutual information.
int numMiLevels(const SearchInput& input) {
  const int levels = input.keyframes.current().keyframe.numLevels();
  int count = 0;
  while (count < levels - 1 && usesMutualInformation(input.parameters, levels - 1 - count)) ++count;
  return count;
}

/// The best of the first sight and of those from other starts: from the last pose, and from the
/// expected one without the coarse levels, which may have led away from it.
Sight compete(const SearchInput& input, const Prediction& prediction, const Sight& first) {
  Sight best = first;
  std::optional<Sight> second_best;
  for (const RecoveryAttempt& attempt :
       {RecoveryAttempt{0, input.state.T_odom_camera, true},
        RecoveryAttempt{0, prediction.T_odom_camera, true, numMiLevels(input)}}) {
    const Sight sight = look(input, prediction, attempt);
    if (!isBelievable(sight)) continue;
    const bool is_better = evidence(input, prediction, sight) > evidence(input, prediction, best);
    const Sight& other = is_better ? best : sight;
    if (isAmbiguous(input, prediction, is_better ? sight : best, other)) second_best = other;
    if (is_better) best = sight;
  }
  if (!second_best || !isAmbiguous(input, prediction, best, *second_best)) return best;
  return coveringBoth(input, best, *second_best);
}

}  // namespace

Sight findCamera(const SearchInput& input, const Prediction& prediction) {
  const Sight first = look(input, prediction, {0, prediction.T_odom_camera, true});
  if (first.alignment.is_live_dark) return first;
  if (!isBelievable(first)) return recover(input, prediction).value_or(first);
  if (isDoubtful(input, prediction, first)) return compete(input, prediction, first);
  return first;
}

}  // namespace mivo
