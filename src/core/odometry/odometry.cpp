// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/odometry.h"

#include <algorithm>
#include <cmath>

#include "core/execution/cpu_clock.h"
#include "core/images/frame_pyramid.h"
#include "core/keyframe/keyframe_store.h"
#include "core/keyframe/keyframe_view.h"
#include "core/odometry/decision.h"
#include "core/odometry/odometry_state.h"
#include "core/odometry/prediction.h"
#include "core/odometry/search.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

void requirePose(const Eigen::Isometry3d& T_odom_camera) {
  if (!T_odom_camera.matrix().allFinite()) throw Error("pose: a number of it is not finite");
  if (!isRigid(T_odom_camera)) throw Error("pose: its 3 x 3 part is not a rotation");
}

}  // namespace

class Odometry::Implementation {
 public:
  Implementation(const Camera& camera, const Parameters& parameters)
      : camera_(camera), parameters_(parameters), wanted_(parameters) {
    camera_.validate();
    parameters_.validate();
  }

  void process(const Frame& frame, const Eigen::Isometry3d* start);
  void reset(const Eigen::Isometry3d& T_odom_camera);
  void setPose(const Eigen::Isometry3d& T_odom_camera);
  void setParameters(const Parameters& parameters);

  Camera camera_;
  Parameters parameters_;        // in use
  Parameters wanted_;            // in use from the next keyframe on
  bool wants_keyframe_ = false;  // wanted_ differs in parameters that act with a keyframe
  OdometryState state_;
  KeyframeStore keyframes_;
  TrackingResult result_;  // of the last frame
  FramePyramid live_;

 private:
  TrackingReason refusal(const Frame& frame) const;
  TrackingResult emptyResult(double stamp) const;
  void prepare(const Frame& frame);
  void finishKeyframe();
  Decision trackOrLose(const Prediction& prediction);
  void commit(const Decision& decision, const Frame& frame);
  bool makeKeyframe(const KeyframePlan& plan, const Frame& frame, OdometryState& state);

  StageTimes milliseconds_;
  FramePyramid reference_;               // of the newest keyframe, until it is finished
  bool keyframe_is_unfinished_ = false;  // its points are chosen, see finishKeyframe()
};

/// Processes one frame.
void Odometry::Implementation::process(const Frame& frame, const Eigen::Isometry3d* start) {
  const double begin = threadMilliseconds();
  milliseconds_ = {};
  if (const TrackingReason reason = refusal(frame); reason != TrackingReason::kNone) {
    const TrackingResult last = result_;
    result_ = emptyResult(std::isfinite(frame.stamp) ? frame.stamp : state_.last_stamp);
    result_.state = last.state;
    result_.reason = reason;
    return;
  }
  prepare(frame);
  const Prediction prediction = predict(state_, frame.stamp, start, parameters_.motion);
  const Decision decision =
      keyframes_.isEmpty()
          ? decideFirst(state_, prediction, emptyResult(frame.stamp), parameters_.motion)
          : trackOrLose(prediction);
  commit(decision, frame);
  result_.milliseconds = milliseconds_;
  result_.milliseconds.total = threadMilliseconds() - begin;
}

TrackingReason Odometry::Implementation::refusal(const Frame& frame) const {
  if (!findFault(frame, camera_).empty()) return TrackingReason::kInvalidFrame;
  const bool is_newer = !state_.has_stamp || frame.stamp > state_.last_stamp;
  return is_newer ? TrackingReason::kNone : TrackingReason::kStaleStamp;
}

/// Result before the frame is tracked: the last pose.
TrackingResult Odometry::Implementation::emptyResult(double stamp) const {
  TrackingResult result;
  result.stamp = stamp;
  result.T_odom_camera = result_.T_odom_camera;
  result.covariance = result_.covariance;
  result.alignment_covariance = result_.alignment_covariance;
  result.keyframe = keyframes_.isEmpty() ? 0 : keyframes_.current().number;
  result.keyframes = state_.num_keyframes;
  result.segment = state_.segment;
  return result;
}

/// Records the stamp, completes the last keyframe, and builds the pyramid of the frame.
void Odometry::Implementation::prepare(const Frame& frame) {
  state_.last_stamp = frame.stamp;
  state_.has_stamp = true;
  state_.clock.add(frame.stamp);
  if (keyframes_.isEmpty()) {
    parameters_ = wanted_;
    wants_keyframe_ = false;
  }
  finishKeyframe();
  const double begin = threadMilliseconds();
  live_.build(frame, parameters_);
  milliseconds_.pyramid = threadMilliseconds() - begin;
}

/// The second half of creating a keyframe is done with the next frame.
void Odometry::Implementation::finishKeyframe() {
  if (!keyframe_is_unfinished_) return;
  const double begin = threadMilliseconds();
  keyframe_is_unfinished_ = false;
  std::swap(live_, reference_);
  keyframes_.current().keyframe.finish(reference_, camera_, parameters_);
  milliseconds_.keyframe += threadMilliseconds() - begin;
}

Decision Odometry::Implementation::trackOrLose(const Prediction& prediction) {
  const SearchInput input{state_, keyframes_, live_, camera_, parameters_};
  const double begin = threadMilliseconds();
  const Sight sight = findCamera(input, prediction);
  milliseconds_.tracking = threadMilliseconds() - begin;
  const TrackingResult result = emptyResult(prediction.stamp);
  if (sight.reason != TrackingReason::kNone) return decideLost(input, prediction, sight, result);
  return decideTracked(input, prediction, sight, wants_keyframe_, result);
}

/// The only place where the state changes.
void Odometry::Implementation::commit(const Decision& decision, const Frame& frame) {
  if (decision.keyframe > 0) keyframes_.choose(decision.keyframe);
  Outcome with = decision.with_keyframe;
  const bool is_made = decision.plan && makeKeyframe(*decision.plan, frame, with.state);
  const Outcome& outcome = is_made ? with : decision.outcome;
  state_ = outcome.state;
  result_ = outcome.result;
  const double period = state_.clock.period(parameters_.motion);
  result_.rolling_shutter_readout = state_.shutter_times.readout * period;
  result_.depth_time_offset = state_.shutter_times.depth_offset * period;
}

/// Makes the frame the current keyframe if it has enough points, with the requested parameters and
/// the current shutter times. Otherwise changes nothing.
bool Odometry::Implementation::makeKeyframe(const KeyframePlan& plan, const Frame& frame,
                                            OdometryState& state) {
  const double begin = threadMilliseconds();
  const bool is_change = wants_keyframe_;
  if (is_change) live_.build(frame, wanted_);
  const double period = state.clock.period(wanted_.motion);
  ShutterModel shutter = state.shutter;
  shutter.endKeyframe(wanted_.shutter, period);
  const ShutterTimes times = shutter.times(wanted_.shutter, period);
  PosedKeyframe& candidate = keyframes_.candidate();
  candidate.keyframe.choosePoints(live_, plan.twist_per_period, times, wanted_);
  if (wanted_.geometry.geometric_term)
    candidate.keyframe.choosePointsByDepth(plan.last_lit_contrast, wanted_);
  milliseconds_.keyframe += threadMilliseconds() - begin;
  if (candidate.keyframe.numPoints() < static_cast<std::size_t>(wanted_.loss.lost_points)) {
    return false;
  }
  candidate.T_odom_keyframe = plan.T_odom_camera;
  candidate.covariance = plan.covariance;
  candidate.last_lit_contrast =
      std::max(plan.last_lit_contrast, candidate.keyframe.contrastInView());
  candidate.number = state.num_keyframes;
  candidate.segment = plan.segment;
  // Keyframes created with other parameters are unusable.
  keyframes_.promote(is_change ? 0 : static_cast<std::size_t>(wanted_.loss.recovery_keyframes));
  parameters_ = wanted_;
  wants_keyframe_ = false;
  state.shutter = shutter;
  state.shutter_times = times;
  keyframe_is_unfinished_ = true;
  return true;
}

void Odometry::Implementation::setParameters(const Parameters& parameters) {
  parameters.validate();
  wanted_ = parameters;
  parameters_ = withLiveParameters(parameters_, wanted_);
  wants_keyframe_ = actWithKeyframe(parameters_, wanted_);
}

void Odometry::Implementation::reset(const Eigen::Isometry3d& T_odom_camera) {
  OdometryState fresh;
  fresh.num_keyframes = state_.num_keyframes;
  fresh.segment = state_.segment;
  fresh.num_segments = state_.num_segments;
  fresh.shutter = state_.shutter;
  fresh.shutter_times = state_.shutter_times;
  if (!keyframes_.isEmpty()) fresh.segment = fresh.num_segments++;
  fresh.T_odom_camera = orthonormalized(T_odom_camera);
  state_ = fresh;
  keyframes_.clear();
  keyframe_is_unfinished_ = false;
  result_ = TrackingResult{};
  result_.T_odom_camera = state_.T_odom_camera;
  result_.keyframes = state_.num_keyframes;
  result_.segment = state_.segment;
}

void Odometry::Implementation::setPose(const Eigen::Isometry3d& T_odom_camera) {
  const Eigen::Isometry3d T_new_old =
      orthonormalized(T_odom_camera) * result_.T_odom_camera.inverse();
  keyframes_.transform(T_new_old);
  state_.T_odom_camera = orthonormalized(T_new_old * state_.T_odom_camera);
  state_.motion.transform(T_new_old);
  result_.T_odom_camera = orthonormalized(T_odom_camera);
}

Odometry::Odometry(const Camera& camera, const Parameters& parameters)
    : implementation_(std::make_unique<Implementation>(camera, parameters)) {}

Odometry::~Odometry() = default;

const TrackingResult& Odometry::process(const Frame& frame) {
  implementation_->process(frame, nullptr);
  return implementation_->result_;
}

const TrackingResult& Odometry::process(const Frame& frame,
                                        const Eigen::Isometry3d& T_odom_camera_start) {
  implementation_->process(frame, &T_odom_camera_start);
  return implementation_->result_;
}

Eigen::Isometry3d Odometry::predictedPose(double stamp) const {
  const Implementation& self = *implementation_;
  return predict(self.state_, stamp, nullptr, self.parameters_.motion).T_odom_camera;
}

void Odometry::reset(const Eigen::Isometry3d& T_odom_camera) {
  requirePose(T_odom_camera);
  implementation_->reset(T_odom_camera);
}

void Odometry::setPose(const Eigen::Isometry3d& T_odom_camera) {
  requirePose(T_odom_camera);
  implementation_->setPose(T_odom_camera);
}

void Odometry::setParameters(const Parameters& parameters) {
  implementation_->setParameters(parameters);
}

const Parameters& Odometry::parameters() const {
  return implementation_->wanted_;
}
const Camera& Odometry::camera() const {
  return implementation_->camera_;
}
const TrackingResult& Odometry::result() const {
  return implementation_->result_;
}
bool Odometry::hasKeyframe() const {
  return !implementation_->keyframes_.isEmpty();
}
Eigen::Isometry3d Odometry::keyframePose() const {
  return hasKeyframe() ? implementation_->keyframes_.current().T_odom_keyframe
                       : Eigen::Isometry3d::Identity();
}
cv::Mat Odometry::keyframeImage() const {
  if (!hasKeyframe()) return {};
  return implementation_->keyframes_.current().keyframe.image().clone();
}

std::vector<CloudPoint> Odometry::keyframeCloud() const {
  if (!hasKeyframe()) return {};
  return makeCloud(implementation_->keyframes_.current().keyframe, implementation_->camera_);
}

cv::Mat Odometry::residualImage() const {
  if (!hasKeyframe()) return {};
  const Implementation& self = *implementation_;
  const PosedKeyframe& current = self.keyframes_.current();
  return makeResidualImage(current.keyframe, self.live_.image(), self.camera_,
                           self.result_.T_odom_camera.inverse() * current.T_odom_keyframe);
}

}  // namespace mivo
