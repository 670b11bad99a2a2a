// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/search.h"

#include <optional>

#include "core/odometry/judgement.h"
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

}  // namespace

Sight findCamera(const SearchInput& input, const Prediction& prediction) {
  const Sight first = look(input, prediction, {0, prediction.T_odom_camera, true});
  if (first.alignment.is_live_dark) return first;
  if (!isBelievable(first)) return recover(input, prediction).value_or(first);
  if (isConvincing(first.alignment, input.parameters.loss)) return first;
  const Sight second = look(input, prediction, {0, input.state.T_odom_camera});
  const bool is_better =
      isBelievable(second) && second.alignment.correlation > first.alignment.correlation;
  return is_better ? second : first;
}

}  // namespace mivo
