// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/odometry.h"

#include <optional>

#include "core/alignment/pose_covariance.h"
#include "core/alignment/tracker.h"
#include "core/execution/cpu_clock.h"
#include "core/images/frame_pyramid.h"
#include "core/keyframe/keyframe.h"
#include "core/keyframe/keyframe_policy.h"
#include "core/keyframe/keyframe_store.h"
#include "core/keyframe/keyframe_view.h"
#include "core/odometry/judgement.h"
#include "core/odometry/motion_model.h"
#include "core/odometry/recovery.h"
#include "core/shutter/shutter_model.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

// Fewer grey levels of contrast are no view that a lost camera could start anew from.
constexpr double kMinContrast = 1.0;
// A dark image is waited for so many times longer.
constexpr int kPatienceInTheDark = 4;
// Motion is not continued for longer than this, periods.
constexpr double kMaxExtrapolation = 30.0;

void requireFinite(const Eigen::Isometry3d& T_odom_camera) {
  if (!T_odom_camera.matrix().allFinite()) throw Error("pose: a number of it is not finite");
}

}  // namespace

class Odometry::Implementation {
 public:
  Implementation(const Camera& camera, const Parameters& parameters)
      : camera_(camera), parameters_(parameters) {
    camera_.validate();
    parameters_.validate();
  }

  void process(const Frame& frame, const Eigen::Isometry3d* start);
  void reset(const Eigen::Isometry3d& T_odom_camera);
  void setPose(const Eigen::Isometry3d& T_odom_camera);
  Eigen::Isometry3d predictedPose(double stamp) const {
    return motion_.predict(stamp, T_odom_camera_, parameters_);
  }

  Camera camera_;
  Parameters parameters_;
  TrackingResult result_;
  FramePyramid live_;
  FramePyramid reference_;  // of the newest keyframe, until it is finished
  KeyframeStore keyframes_;
  bool keyframes_are_outdated_ = false;  // a parameter changed that they were made with

 private:
  void startResult(const Frame& frame);
  TrackingReason refusal(const Frame& frame) const;
  void finishKeyframe();
  void startFirstKeyframe(const Frame& frame, const Eigen::Isometry3d& T_odom_camera_start);
  Alignment alignWith(const PosedKeyframe& keyframe, const Frame& frame,
                      const Eigen::Isometry3d& T_odom_camera_start) const;
  void track(const Frame& frame, const Eigen::Isometry3d& T_odom_camera_start);
  std::optional<Alignment> recover(const Frame& frame);
  void record(const Alignment& alignment);
  void accept(const Frame& frame, const Alignment& alignment);
  void lose(const Frame& frame, const Eigen::Isometry3d& guess, TrackingReason reason,
            bool is_dark);
  bool makeKeyframe(const Eigen::Isometry3d& T_odom_camera, const Vector6& twist_per_period,
                    const Matrix6& covariance, double last_lit_contrast = 0.0);
  ShutterTimes shutter() const { return shutter_.times(parameters_, motion_.period(parameters_)); }
  TrackingReason judge(const Frame& frame, const PosedKeyframe& keyframe,
                       const Alignment& alignment) const;

  MotionModel motion_;
  ShutterModel shutter_;
  KeyframeQuality first_quality_;  // of the first frame tracked against the keyframe
  Eigen::Isometry3d T_odom_camera_ = Eigen::Isometry3d::Identity();  // last pose to be trusted
  double pose_stamp_ = 0.0;
  double last_stamp_ = 0.0;
  bool has_stamp_ = false;
  bool keyframe_is_unfinished_ = false;  // its points are chosen, see finishKeyframe()
  bool is_pose_given_ = true;            // the next keyframe's pose is the user's, not a guess
  int num_keyframes_ = 0;
  int segment_ = 0;       // of the last pose
  int num_segments_ = 1;  // so far
  int lost_in_a_row_ = 0;
};

void Odometry::Implementation::startResult(const Frame& frame) {
  const TrackingResult last = result_;
  result_ = TrackingResult{};
  result_.stamp = std::isfinite(frame.stamp) ? frame.stamp : last_stamp_;
  result_.state = last.state;
  result_.T_odom_camera = last.T_odom_camera;
  result_.covariance = last.covariance;
  result_.alignment_covariance = last.alignment_covariance;
  result_.keyframe = keyframes_.isEmpty() ? 0 : keyframes_.current().number;
  result_.keyframes = num_keyframes_;
  result_.segment = segment_;
}

TrackingReason Odometry::Implementation::refusal(const Frame& frame) const {
  if (!findFault(frame, camera_).empty()) return TrackingReason::kInvalidFrame;
  const bool is_newer = !has_stamp_ || frame.stamp > last_stamp_;
  return is_newer ? TrackingReason::kNone : TrackingReason::kStaleStamp;
}

void Odometry::Implementation::process(const Frame& frame, const Eigen::Isometry3d* start) {
  const double begin = threadMilliseconds();
  startResult(frame);
  result_.reason = refusal(frame);
  if (result_.isRefused()) return;
  last_stamp_ = frame.stamp;
  has_stamp_ = true;
  motion_.addStamp(frame.stamp);
  if (keyframes_are_outdated_) {
    // Made with other parameters: the frame takes their place before it can be compared.
    keyframes_.clear();
    keyframes_are_outdated_ = false;
    keyframe_is_unfinished_ = false;
    lost_in_a_row_ = 0;
  }
  finishKeyframe();
  const double finished = threadMilliseconds();
  live_.build(frame, parameters_);
  result_.milliseconds.pyramid = threadMilliseconds() - finished;

  const Eigen::Isometry3d T_odom_camera_start =
      start != nullptr && start->matrix().allFinite() ? *start : predictedPose(frame.stamp);
  if (keyframes_.isEmpty()) {
    startFirstKeyframe(frame, T_odom_camera_start);
  } else {
    track(frame, T_odom_camera_start);
  }
  result_.keyframes = num_keyframes_;
  result_.segment = segment_;
  const double period = motion_.period(parameters_);
  const ShutterTimes times = shutter_.times(parameters_, period);
  result_.rolling_shutter_readout = times.readout * period;
  result_.depth_time_offset = times.depth_offset * period;
  result_.milliseconds.total = threadMilliseconds() - begin;
}

/// The second half of making a keyframe is left to the frame after it.
void Odometry::Implementation::finishKeyframe() {
  if (!keyframe_is_unfinished_) return;
  const double begin = threadMilliseconds();
  keyframe_is_unfinished_ = false;
  std::swap(live_, reference_);
  keyframes_.current().keyframe.finish(reference_, camera_, parameters_);
  result_.milliseconds.keyframe += threadMilliseconds() - begin;
}

void Odometry::Implementation::startFirstKeyframe(const Frame& frame,
                                                  const Eigen::Isometry3d& T_odom_camera_start) {
  // A pose that was given is true by definition; later ones without a keyframe are predicted.
  const Matrix6 covariance = is_pose_given_ ? floorCovariance() : guessCovariance();
  result_.alignment_covariance = covariance;
  result_.T_odom_camera = T_odom_camera_start;
  if (!makeKeyframe(T_odom_camera_start, Vector6::Zero(), covariance)) {
    result_.state = TrackingState::kInitialising;
    result_.reason = TrackingReason::kTooFewPoints;
    result_.covariance = result_.alignment_covariance = guessCovariance();
    return;
  }
  is_pose_given_ = false;
  result_.state = TrackingState::kTracking;
  T_odom_camera_ = T_odom_camera_start;
  result_.covariance = covariance;
  result_.overlap = 1.0;
  motion_.add(frame.stamp, T_odom_camera_);
  pose_stamp_ = frame.stamp;
}

Alignment Odometry::Implementation::alignWith(const PosedKeyframe& keyframe, const Frame& frame,
                                              const Eigen::Isometry3d& T_odom_camera_start) const {
  const Eigen::Isometry3d T_start_ref = T_odom_camera_start.inverse() * keyframe.T_odom_keyframe;
  // From another segment nothing leads here: the camera counts as standing still.
  const Eigen::Isometry3d T_previous_ref = keyframe.segment == segment_
                                               ? T_odom_camera_.inverse() * keyframe.T_odom_keyframe
                                               : T_start_ref;
  return align({keyframe.keyframe, live_, camera_, T_start_ref, T_previous_ref,
                motion_.periodsSince(frame.stamp, parameters_), shutter(),
                keyframe.last_lit_contrast, motion_.uncertainty(frame.stamp, parameters_)},
               parameters_);
}

void Odometry::Implementation::track(const Frame& frame,
                                     const Eigen::Isometry3d& T_odom_camera_start) {
  const double begin = threadMilliseconds();
  Alignment alignment = alignWith(keyframes_.current(), frame, T_odom_camera_start);
  TrackingReason reason = judge(frame, keyframes_.current(), alignment);
  if (!alignment.is_live_dark &&
      (reason != TrackingReason::kNone || !isConvincing(alignment, parameters_))) {
    if (reason == TrackingReason::kNone) {
      const Alignment second = alignWith(keyframes_.current(), frame, T_odom_camera_);
      if (judge(frame, keyframes_.current(), second) == TrackingReason::kNone &&
          second.correlation > alignment.correlation) {
        alignment = second;
      }
    } else if (const auto found = recover(frame)) {
      alignment = *found;
      reason = TrackingReason::kNone;
    }
  }
  result_.milliseconds.tracking = threadMilliseconds() - begin;
  record(alignment);
  if (reason == TrackingReason::kNone) {
    accept(frame, alignment);
  } else {
    lose(frame, T_odom_camera_start, reason, alignment.is_live_dark);
  }
}

/// Tries other starts and other keyframes. The keyframe that works becomes the current one.
std::optional<Alignment> Odometry::Implementation::recover(const Frame& frame) {
  const double periods = motion_.periodsSince(frame.stamp, parameters_);
  const Eigen::Isometry3d T_odom_predicted =
      periods <= kMaxExtrapolation ? predictedPose(frame.stamp) : T_odom_camera_;
  for (const RecoveryAttempt& attempt :
       recoveryAttempts(keyframes_, T_odom_camera_, T_odom_predicted, lost_in_a_row_)) {
    const PosedKeyframe& keyframe = keyframes_.at(attempt.keyframe);
    const Alignment alignment = alignWith(keyframe, frame, attempt.T_odom_camera);
    if (judge(frame, keyframe, alignment) != TrackingReason::kNone ||
        !isConvincing(alignment, parameters_)) {
      continue;
    }
    if (attempt.keyframe > 0) {
      keyframes_.choose(attempt.keyframe);
      first_quality_ = {};
      result_.keyframe = keyframe.number;
    }
    return alignment;
  }
  return std::nullopt;
}

void Odometry::Implementation::record(const Alignment& alignment) {
  result_.num_levels = alignment.num_levels;
  result_.levels = alignment.levels;
  result_.points = alignment.points;
  result_.overlap = alignment.overlap;
  result_.mutual_information = alignment.mutual_information;
  result_.residual_scale = alignment.residual_scale;
  result_.correlation = alignment.correlation;
}

/// Of one segment, the motion since the last frame counts, too.
TrackingReason Odometry::Implementation::judge(const Frame& frame, const PosedKeyframe& keyframe,
                                               const Alignment& alignment) const {
  const TrackingReason reason = mivo::judge(alignment, parameters_);
  if (reason != TrackingReason::kNone || keyframe.segment != segment_) return reason;
  const Vector6 motion = localCoordinates(T_odom_camera_.inverse() * keyframe.T_odom_keyframe *
                                          alignment.T_live_ref.inverse());
  return judgeMotion(motion, frame.stamp - pose_stamp_, parameters_);
}

void Odometry::Implementation::accept(const Frame& frame, const Alignment& alignment) {
  const Eigen::Isometry3d T_odom_previous = T_odom_camera_;
  const PosedKeyframe& keyframe = keyframes_.current();
  T_odom_camera_ = orthonormalised(keyframe.T_odom_keyframe * alignment.T_live_ref.inverse());
  Vector6 twist_per_period = localCoordinates(T_odom_camera_.inverse() * T_odom_previous) /
                             motion_.periodsSince(frame.stamp, parameters_);
  // Over a long gap, or from another segment, the mean velocity is not the present one.
  if (lost_in_a_row_ >= parameters_.loss.lost_frames || keyframe.segment != segment_) {
    motion_.stop();
    twist_per_period.setZero();
  }
  pose_stamp_ = frame.stamp;
  lost_in_a_row_ = 0;
  segment_ = keyframe.segment;
  motion_.add(frame.stamp, T_odom_camera_);
  const Quality quality = qualityOf(alignment, parameters_);
  result_.state = quality.state;
  result_.reason = quality.reason;
  // Held against a keyframe whose own velocity is not known, a frame says nothing about the rows.
  if (!keyframe.keyframe.twistPerPeriod().isZero(0.0)) shutter_.add(alignment);
  result_.T_odom_camera = T_odom_camera_;
  result_.alignment_covariance =
      liveCovariance(alignment.T_live_ref, alignment.covariance, Matrix6::Zero());
  result_.covariance =
      liveCovariance(alignment.T_live_ref, alignment.covariance, keyframe.covariance);
  result_.velocity = motion_.velocity(parameters_);
  if (first_quality_.mutual_information == 0.0 && first_quality_.residual_scale == 0.0) {
    first_quality_ = {alignment.mutual_information, alignment.residual_scale,
                      alignment.correlation};
  }
  if (needsNewKeyframe(alignment, keyframe.keyframe, first_quality_, parameters_)) {
    // In the dark the next keyframe shows less than what there is to see.
    const bool is_lit = alignment.sees_image && !alignment.is_live_dark;
    const double last_lit_contrast = is_lit ? 0.0 : keyframe.last_lit_contrast;
    makeKeyframe(T_odom_camera_, twist_per_period, result_.covariance, last_lit_contrast);
  }
}

void Odometry::Implementation::lose(const Frame& frame, const Eigen::Isometry3d& guess,
                                    TrackingReason reason, bool is_dark) {
  ++lost_in_a_row_;
  result_.state = TrackingState::kLost;
  result_.reason = reason;
  // One frame may be bridged by its velocity; after that the last good pose is the best guess.
  result_.T_odom_camera = lost_in_a_row_ == 1 ? guess : T_odom_camera_;
  result_.covariance = result_.alignment_covariance = guessCovariance();
  const int patience = parameters_.loss.lost_frames * (is_dark ? kPatienceInTheDark : 1);
  if (lost_in_a_row_ < patience || live_.contrastInView() < kMinContrast ||
      parameters_.keyframes.keyframe_policy == KeyframePolicy::kFirst) {
    return;
  }
  const int segment = segment_;
  segment_ = num_segments_;
  if (!makeKeyframe(T_odom_camera_, Vector6::Zero(), guessCovariance())) {
    segment_ = segment;
    return;
  }
  ++num_segments_;
  lost_in_a_row_ = 0;
  motion_.stop();
  motion_.add(frame.stamp, T_odom_camera_);
  pose_stamp_ = frame.stamp;
}

bool Odometry::Implementation::makeKeyframe(const Eigen::Isometry3d& T_odom_camera,
                                            const Vector6& twist_per_period,
                                            const Matrix6& covariance, double last_lit_contrast) {
  const double begin = threadMilliseconds();
  shutter_.endKeyframe(parameters_, motion_.period(parameters_));
  PosedKeyframe& candidate = keyframes_.candidate();
  candidate.keyframe.choosePoints(live_, twist_per_period, shutter(), parameters_);
  if (last_lit_contrast > candidate.keyframe.contrastInView() &&
      parameters_.geometry.geometric_term) {
    candidate.keyframe.choosePointsByDepth(parameters_);
  }
  result_.milliseconds.keyframe += threadMilliseconds() - begin;
  if (candidate.keyframe.numPoints() < static_cast<std::size_t>(parameters_.loss.lost_points)) {
    return false;
  }
  candidate.T_odom_keyframe = T_odom_camera;
  candidate.covariance = covariance;
  candidate.last_lit_contrast = std::max(last_lit_contrast, candidate.keyframe.contrastInView());
  candidate.number = ++num_keyframes_;
  candidate.segment = segment_;
  keyframe_is_unfinished_ = true;
  keyframes_.promote(static_cast<std::size_t>(parameters_.loss.recovery_keyframes));
  first_quality_ = {};
  result_.new_keyframe = true;
  return true;
}

void Odometry::Implementation::reset(const Eigen::Isometry3d& T_odom_camera) {
  if (!keyframes_.isEmpty()) segment_ = num_segments_++;
  keyframes_.clear();
  keyframe_is_unfinished_ = false;
  has_stamp_ = false;
  motion_ = MotionModel();
  lost_in_a_row_ = 0;
  is_pose_given_ = true;
  T_odom_camera_ = orthonormalised(T_odom_camera);
  result_ = TrackingResult{};
  result_.T_odom_camera = T_odom_camera_;
  result_.keyframes = num_keyframes_;
  result_.segment = segment_;
}

void Odometry::Implementation::setPose(const Eigen::Isometry3d& T_odom_camera) {
  const Eigen::Isometry3d T_new_old =
      orthonormalised(T_odom_camera) * result_.T_odom_camera.inverse();
  keyframes_.transform(T_new_old);
  T_odom_camera_ = orthonormalised(T_new_old * T_odom_camera_);
  result_.T_odom_camera = orthonormalised(T_odom_camera);
  motion_.transform(T_new_old);
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
  return implementation_->predictedPose(stamp);
}

void Odometry::reset(const Eigen::Isometry3d& T_odom_camera) {
  requireFinite(T_odom_camera);
  implementation_->reset(T_odom_camera);
}

void Odometry::setPose(const Eigen::Isometry3d& T_odom_camera) {
  requireFinite(T_odom_camera);
  implementation_->setPose(T_odom_camera);
}

void Odometry::setParameters(const Parameters& parameters) {
  parameters.validate();
  Implementation& self = *implementation_;
  if (actWithKeyframe(self.parameters_, parameters)) self.keyframes_are_outdated_ = true;
  self.parameters_ = parameters;
}

const Parameters& Odometry::parameters() const {
  return implementation_->parameters_;
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
