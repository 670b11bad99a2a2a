// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/decision.h"

#include <algorithm>

#include "core/alignment/pose_covariance.h"
#include "core/keyframe/keyframe_policy.h"
#include "core/odometry/judgment.h"

namespace mivo {
namespace {

// Gray levels: with less contrast no new segment is started.
constexpr double kMinContrast = 1.0;
// Factor on lost_frames for dark images: the light may return.
constexpr int kLostPatienceInTheDark = 4;

void record(const Alignment& alignment, TrackingResult& result) {
  result.num_levels = alignment.num_levels;
  result.levels = alignment.levels;
  result.points = alignment.points;
  result.overlap = alignment.overlap;
  result.mutual_information = alignment.mutual_information;
  result.residual_scale = alignment.residual_scale;
  result.correlation = alignment.correlation;
}

MeasuredPose measuredPose(const Prediction& prediction, const TrackingResult& result) {
  MeasuredPose pose;
  pose.stamp = prediction.stamp;
  pose.T_odom_camera = result.T_odom_camera;
  pose.covariance = result.covariance;
  pose.alignment_covariance = result.alignment_covariance;
  return pose;
}

/// The outcome with one more keyframe.
Outcome withKeyframe(const Outcome& outcome) {
  Outcome with = outcome;
  with.state.first_quality = {};
  with.result.keyframes = ++with.state.num_keyframes;
  with.result.new_keyframe = true;
  return with;
}

/// Updates pose, velocity and shutter from the alignment.
void follow(const SearchInput& input, const Prediction& prediction, const Sight& sight,
            OdometryState& state, TrackingResult& result) {
  const PosedKeyframe& keyframe = input.keyframes.at(sight.keyframe);
  const Alignment& alignment = sight.alignment;
  state.T_odom_camera = orthonormalized(keyframe.T_odom_keyframe * alignment.T_live_ref.inverse());
  state.pose_stamp = prediction.stamp;
  state.lost_in_a_row = 0;
  state.segment = keyframe.segment;
  result.T_odom_camera = state.T_odom_camera;
  result.alignment_covariance =
      liveCovariance(alignment.T_live_ref, alignment.covariance, Matrix6::Zero());
  result.covariance =
      liveCovariance(alignment.T_live_ref, alignment.covariance, keyframe.covariance);
  MeasuredPose pose = measuredPose(prediction, result);
  pose.has_open_directions = alignment.has_open_directions;
  pose.open_projector = alignment.open_projector;
  // What may be wrong does not lead the next frame.
  if (!sight.is_ambiguous) state.motion.add(pose, state.clock, input.parameters.motion);
  result.velocity = state.motion.velocity(state.clock, input.parameters.motion);
  // Without the keyframe's own velocity, a frame contains no information about the rows.
  if (!keyframe.keyframe.twistPerPeriod().isZero(0.0)) state.shutter.add(alignment);
}

}  // namespace

Decision decideFirst(const OdometryState& state, const Prediction& prediction,
                     const TrackingResult& result, const MotionParameters& parameters) {
  Decision decision;
  decision.outcome = {state, result};
  TrackingResult& without = decision.outcome.result;
  without.T_odom_camera = prediction.T_odom_camera;
  without.state = TrackingState::kInitializing;
  without.reason = TrackingReason::kTooFewPoints;
  without.covariance = without.alignment_covariance = guessCovariance();

  // A given pose is true by definition; later ones without a keyframe are guesses.
  KeyframePlan plan;
  plan.T_odom_camera = prediction.T_odom_camera;
  plan.covariance = state.is_pose_given ? floorCovariance() : guessCovariance();
  plan.segment = state.segment;
  decision.plan = plan;

  decision.with_keyframe = withKeyframe(decision.outcome);
  TrackingResult& with = decision.with_keyframe.result;
  with.state = TrackingState::kTracking;
  with.reason = TrackingReason::kNone;
  with.covariance = with.alignment_covariance = plan.covariance;
  with.overlap = 1.0;
  OdometryState& next = decision.with_keyframe.state;
  next.is_pose_given = false;
  next.T_odom_camera = prediction.T_odom_camera;
  next.pose_stamp = prediction.stamp;
  next.motion.add(measuredPose(prediction, with), next.clock, parameters);
  return decision;
}

Decision decideTracked(const SearchInput& input, const Prediction& prediction, const Sight& sight,
                       bool must_become_keyframe, const TrackingResult& result) {
  const PosedKeyframe& keyframe = input.keyframes.at(sight.keyframe);
  const Alignment& alignment = sight.alignment;
  Decision decision;
  decision.keyframe = sight.keyframe;
  decision.outcome = {input.state, result};
  OdometryState& state = decision.outcome.state;
  TrackingResult& said = decision.outcome.result;
  record(alignment, said);
  said.keyframe = keyframe.number;
  // After a long loss, or from another segment, the mean velocity is not the current one.
  const bool is_continued =
      state.lost_in_a_row < input.parameters.loss.lost_frames && keyframe.segment == state.segment;
  const Eigen::Isometry3d T_odom_previous = state.T_odom_camera;
  if (!is_continued) state.motion.stop();
  follow(input, prediction, sight, state, said);
  said.segment = state.segment;
  const Quality quality = qualityOf(alignment, sight.is_ambiguous);
  said.state = quality.state;
  said.reason = quality.reason;
  if (alignment.has_open_directions) said.open_directions = alignment.open_directions;
  if (sight.keyframe > 0) state.first_quality = {};
  if (state.first_quality.mutual_information == 0.0 && state.first_quality.residual_scale == 0.0) {
    state.first_quality = {alignment.mutual_information, alignment.residual_scale,
                           alignment.correlation};
  }
  const bool is_wanted =
      must_become_keyframe ||
      needsNewKeyframe(alignment, keyframe.keyframe, state.first_quality, input.parameters);
  if (!is_wanted || sight.is_ambiguous) return decision;
  KeyframePlan plan;
  plan.T_odom_camera = state.T_odom_camera;
  if (is_continued) {
    plan.twist_per_period =
        localCoordinates(state.T_odom_camera.inverse() * T_odom_previous) / prediction.periods;
  }
  plan.covariance = said.covariance;
  // The contrast of a keyframe created in the dark is not the scene's.
  const bool is_lit = alignment.sees_image && !alignment.is_live_dark;
  plan.last_lit_contrast = is_lit ? 0.0 : keyframe.last_lit_contrast;
  plan.segment = state.segment;
  decision.plan = plan;
  decision.with_keyframe = withKeyframe(decision.outcome);
  return decision;
}

Decision decideLost(const SearchInput& input, const Prediction& prediction, const Sight& sight,
                    const TrackingResult& result) {
  Decision decision;
  decision.outcome = {input.state, result};
  OdometryState& state = decision.outcome.state;
  TrackingResult& said = decision.outcome.result;
  record(sight.alignment, said);
  ++state.lost_in_a_row;
  said.state = TrackingState::kLost;
  said.reason = sight.reason;
  said.T_odom_camera = bestGuess(state, prediction);
  said.covariance = said.alignment_covariance = guessCovariance() + prediction.covariance;
  const int patience = input.parameters.loss.lost_frames *
                       (sight.alignment.is_live_dark ? kLostPatienceInTheDark : 1);
  if (state.lost_in_a_row < patience || input.live.contrastInView() < kMinContrast ||
      input.parameters.keyframes.keyframe_policy == KeyframePolicy::kFirst) {
    return decision;
  }
  KeyframePlan plan;
  plan.T_odom_camera = said.T_odom_camera;
  plan.covariance = said.covariance;
  plan.segment = state.num_segments;
  decision.plan = plan;
  decision.with_keyframe = withKeyframe(decision.outcome);
  OdometryState& next = decision.with_keyframe.state;
  next.segment = next.num_segments++;
  next.lost_in_a_row = 0;
  next.T_odom_camera = said.T_odom_camera;
  next.pose_stamp = prediction.stamp;
  next.motion.stop();
  next.motion.add(measuredPose(prediction, said), next.clock, input.parameters.motion);
  decision.with_keyframe.result.segment = next.segment;
  return decision;
}

}  // namespace mivo
