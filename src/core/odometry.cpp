// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/odometry.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "mivo/core/cpu_clock.h"
#include "mivo/core/error.h"
#include "mivo/core/frame_pyramid.h"
#include "mivo/core/keyframe.h"
#include "mivo/core/keyframe_policy.h"
#include "mivo/core/keyframe_view.h"
#include "mivo/core/motion_model.h"
#include "mivo/core/tracker.h"

namespace mivo {
namespace {

// Standard deviations of a pose that is only a guess: m and rad.
constexpr double kGuessTranslation = 1.0;
constexpr double kGuessRotation = 1.0;
// No pose is known better than this: the rounding of depth and of the camera's parameters.
constexpr double kFloorTranslation = 1e-5;
constexpr double kFloorRotation = 1e-5;

Matrix6 diagonalCovariance(double translation, double rotation) {
  Vector6 variance;
  variance.head<3>().setConstant(translation * translation);
  variance.tail<3>().setConstant(rotation * rotation);
  return variance.asDiagonal();
}

/// Covariance of the pose's error in the axes of the camera. The increment d lives in the keyframe:
/// T_odom_live = T_odom_ref retract(d) T_ref_live, which moves the live camera by Ad(T_live_ref) d.
Matrix6 poseCovariance(const Alignment& alignment) {
  const Matrix6 of_increment = alignment.information.ldlt().solve(Matrix6(Matrix6::Identity()));
  const Matrix6 Ad = adjoint(alignment.T_live_ref);
  const Matrix6 covariance = Ad * of_increment * Ad.transpose();
  return 0.5 * (covariance + covariance.transpose()) +
         diagonalCovariance(kFloorTranslation, kFloorRotation);
}

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
  Keyframe keyframe_;
  bool has_keyframe_ = false;
  bool keyframe_is_outdated_ = false;  // a parameter changed that it was made with
  Eigen::Isometry3d T_odom_keyframe_ = Eigen::Isometry3d::Identity();

 private:
  void startResult(const Frame& frame);
  bool isUsable(const Frame& frame);
  void track(const Frame& frame, const Eigen::Isometry3d& T_odom_camera_start);
  void accept(const Frame& frame, const Alignment& alignment);
  void lose(const Frame& frame, const Eigen::Isometry3d& guess, TrackingReason reason);
  void setQuality(const Alignment& alignment);
  bool makeKeyframe(const Eigen::Isometry3d& T_odom_camera, const Vector6& twist_per_period);
  double readout() const;
  ShutterTimes shutter() const;
  TrackingReason judge(const Frame& frame, const Alignment& alignment) const;

  MotionModel motion_;
  ReadoutEstimator readout_;
  Keyframe candidate_;  // for the next keyframe: the last but one, whose memory serves again
  KeyframeQuality first_quality_;  // of the first frame tracked against the keyframe
  Eigen::Isometry3d T_odom_camera_ = Eigen::Isometry3d::Identity();  // last pose to be trusted
  double pose_stamp_ = 0.0;
  double last_stamp_ = 0.0;
  bool has_stamp_ = false;
  int keyframes_ = 0;
  int segment_ = 0;
  int lost_in_a_row_ = 0;
};

void Odometry::Implementation::startResult(const Frame& frame) {
  const TrackingResult last = result_;
  result_ = TrackingResult{};
  result_.stamp = std::isfinite(frame.stamp) ? frame.stamp : last_stamp_;
  result_.state = last.state;
  result_.T_odom_camera = last.T_odom_camera;
  result_.covariance = last.covariance;
  result_.keyframe = has_keyframe_ ? keyframes_ : 0;
  result_.keyframes = keyframes_;
  result_.segment = segment_;
}

bool Odometry::Implementation::isUsable(const Frame& frame) {
  return findFault(frame, camera_).empty() && (!has_stamp_ || frame.stamp > last_stamp_);
}

void Odometry::Implementation::process(const Frame& frame, const Eigen::Isometry3d* start) {
  const double begin = threadMilliseconds();
  startResult(frame);
  if (!isUsable(frame)) {
    result_.reason = TrackingReason::kInvalidFrame;
    return;
  }
  last_stamp_ = frame.stamp;
  has_stamp_ = true;
  motion_.addStamp(frame.stamp);
  live_.build(frame, parameters_);
  result_.milliseconds.pyramid = threadMilliseconds() - begin;

  const Eigen::Isometry3d T_odom_camera_start =
      start != nullptr && start->matrix().allFinite() ? *start : predictedPose(frame.stamp);
  if (has_keyframe_ && keyframe_is_outdated_) {
    // Made with other parameters: the frame takes its place before it can be compared.
    has_keyframe_ = false;
    lost_in_a_row_ = 0;
  }
  if (has_keyframe_) {
    track(frame, T_odom_camera_start);
  } else if (makeKeyframe(T_odom_camera_start, Vector6::Zero())) {
    result_.state = TrackingState::kTracking;
    result_.T_odom_camera = T_odom_camera_ = T_odom_camera_start;
    // The first pose is true by definition; later ones without a keyframe are predicted.
    result_.covariance = keyframes_ == 1 ? diagonalCovariance(kFloorTranslation, kFloorRotation)
                                         : diagonalCovariance(kGuessTranslation, kGuessRotation);
    result_.overlap = 1.0;
    motion_.add(frame.stamp, T_odom_camera_);
    pose_stamp_ = frame.stamp;
  } else {
    result_.state = TrackingState::kInitialising;
    result_.reason = TrackingReason::kTooFewPoints;
    result_.T_odom_camera = T_odom_camera_start;
    result_.covariance = diagonalCovariance(kGuessTranslation, kGuessRotation);
  }
  result_.keyframes = keyframes_;
  result_.segment = segment_;
  result_.rolling_shutter_readout = readout() * motion_.period(parameters_);
  result_.milliseconds.total = threadMilliseconds() - begin;
}

void Odometry::Implementation::track(const Frame& frame,
                                     const Eigen::Isometry3d& T_odom_camera_start) {
  const double begin = threadMilliseconds();
  const Alignment alignment =
      align({keyframe_, live_, camera_, T_odom_camera_start.inverse() * T_odom_keyframe_,
             T_odom_camera_.inverse() * T_odom_keyframe_,
             motion_.periodsSince(frame.stamp, parameters_), shutter()},
            parameters_);
  result_.milliseconds.tracking = threadMilliseconds() - begin;
  result_.num_levels = alignment.num_levels;
  result_.levels = alignment.levels;
  result_.points = alignment.points;
  result_.overlap = alignment.overlap;
  result_.mutual_information = alignment.mutual_information;
  result_.residual_scale = alignment.residual_scale;
  result_.correlation = alignment.correlation;

  const TrackingReason reason = judge(frame, alignment);
  if (reason == TrackingReason::kNone) {
    accept(frame, alignment);
  } else {
    lose(frame, T_odom_camera_start, reason);
  }
}

TrackingReason Odometry::Implementation::judge(const Frame& frame,
                                               const Alignment& alignment) const {
  if (!alignment.T_live_ref.matrix().allFinite() || !alignment.information.allFinite()) {
    return TrackingReason::kNotFinite;
  }
  // In the dark depth alone knows the way. But an image that shows something else is of another
  // place, however well some of its planes fit.
  if (!alignment.sees_image && !(alignment.sees_depth && alignment.is_blind)) {
    return TrackingReason::kNoInformation;
  }
  if (alignment.overlap < parameters_.lost_overlap) return TrackingReason::kNoOverlap;
  if (alignment.points < parameters_.lost_points) return TrackingReason::kTooFewPoints;
  if (!(poseCovariance(alignment).ldlt().isPositive()) || !poseCovariance(alignment).allFinite()) {
    return TrackingReason::kSingular;
  }
  const double seconds = frame.stamp - pose_stamp_;
  const Vector6 motion = localCoordinates(T_odom_camera_.inverse() * T_odom_keyframe_ *
                                          alignment.T_live_ref.inverse());
  if (motion.head<3>().norm() > parameters_.lost_speed * seconds ||
      motion.tail<3>().norm() > parameters_.lost_turn_rate * seconds) {
    return TrackingReason::kImplausibleMotion;
  }
  return TrackingReason::kNone;
}

void Odometry::Implementation::accept(const Frame& frame, const Alignment& alignment) {
  const Eigen::Isometry3d T_odom_previous = T_odom_camera_;
  T_odom_camera_ = orthonormalised(T_odom_keyframe_ * alignment.T_live_ref.inverse());
  const Vector6 twist_per_period = localCoordinates(T_odom_camera_.inverse() * T_odom_previous) /
                                   motion_.periodsSince(frame.stamp, parameters_);
  pose_stamp_ = frame.stamp;
  lost_in_a_row_ = 0;
  motion_.add(frame.stamp, T_odom_camera_);
  setQuality(alignment);
  // Held against a keyframe whose own velocity is not known, a frame says nothing about the rows.
  if (!keyframe_.twistPerPeriod().isZero(0.0)) readout_.add(alignment.readout);
  result_.T_odom_camera = T_odom_camera_;
  result_.covariance = poseCovariance(alignment);
  result_.velocity = motion_.velocity(parameters_);
  if (first_quality_.mutual_information == 0.0 && first_quality_.residual_scale == 0.0) {
    first_quality_ = {alignment.mutual_information, alignment.residual_scale};
  }
  if (needsNewKeyframe(alignment, keyframe_, first_quality_, parameters_)) {
    makeKeyframe(T_odom_camera_, twist_per_period);
  }
}

void Odometry::Implementation::setQuality(const Alignment& alignment) {
  result_.state = TrackingState::kDegraded;
  if (!alignment.sees_image) {
    result_.reason = TrackingReason::kNoInformation;
  } else if (alignment.condition < parameters_.degraded_curvature) {
    result_.reason = TrackingReason::kSingular;
  } else {
    result_.state = TrackingState::kTracking;
  }
}

void Odometry::Implementation::lose(const Frame& frame, const Eigen::Isometry3d& guess,
                                    TrackingReason reason) {
  result_.state = TrackingState::kLost;
  result_.reason = reason;
  result_.T_odom_camera = guess;
  result_.covariance = diagonalCovariance(kGuessTranslation, kGuessRotation);
  ++lost_in_a_row_;
  // One frame may be bridged by its velocity; after that the last good pose is the best guess.
  if (lost_in_a_row_ > 1) motion_.stop();
  if (lost_in_a_row_ >= parameters_.lost_frames &&
      parameters_.keyframe_policy != KeyframePolicy::kFirst &&
      makeKeyframe(guess, Vector6::Zero())) {
    ++segment_;
    lost_in_a_row_ = 0;
    motion_.stop();
    motion_.add(frame.stamp, guess);
    T_odom_camera_ = guess;
    pose_stamp_ = frame.stamp;
  }
}

/// Time to read the rows of an image as a share of the frame period.
double Odometry::Implementation::readout() const {
  if (parameters_.rolling_shutter_readout == 0.0) {
    return parameters_.rolling_shutter_estimation ? readout_.readout() : 0.0;
  }
  const double period = motion_.period(parameters_);
  return period > 0.0 ? std::min(1.0, parameters_.rolling_shutter_readout / period) : 0.0;
}

ShutterTimes Odometry::Implementation::shutter() const {
  ShutterTimes times;
  times.readout = readout();
  const double period = motion_.period(parameters_);
  if (period > 0.0) times.depth_offset = parameters_.depth_time_offset / period;
  return times;
}

bool Odometry::Implementation::makeKeyframe(const Eigen::Isometry3d& T_odom_camera,
                                            const Vector6& twist_per_period) {
  const double begin = threadMilliseconds();
  readout_.endKeyframe();
  candidate_.build(live_, camera_, twist_per_period, shutter(), parameters_);
  result_.milliseconds.keyframe = threadMilliseconds() - begin;
  if (candidate_.numPoints() < static_cast<std::size_t>(parameters_.lost_points)) return false;
  std::swap(keyframe_, candidate_);
  has_keyframe_ = true;
  keyframe_is_outdated_ = false;
  T_odom_keyframe_ = T_odom_camera;
  first_quality_ = {};
  ++keyframes_;
  result_.new_keyframe = true;
  return true;
}

void Odometry::Implementation::reset(const Eigen::Isometry3d& T_odom_camera) {
  if (has_keyframe_) ++segment_;
  has_keyframe_ = false;
  has_stamp_ = false;
  motion_ = MotionModel();
  lost_in_a_row_ = 0;
  T_odom_camera_ = orthonormalised(T_odom_camera);
  result_ = TrackingResult{};
  result_.T_odom_camera = T_odom_camera_;
  result_.keyframes = keyframes_;
  result_.segment = segment_;
}

void Odometry::Implementation::setPose(const Eigen::Isometry3d& T_odom_camera) {
  const Eigen::Isometry3d T_new_old =
      orthonormalised(T_odom_camera) * result_.T_odom_camera.inverse();
  T_odom_keyframe_ = orthonormalised(T_new_old * T_odom_keyframe_);
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
  if (needsNewKeyframe(self.parameters_, parameters)) self.keyframe_is_outdated_ = true;
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
  return implementation_->has_keyframe_;
}
Eigen::Isometry3d Odometry::keyframePose() const {
  return implementation_->T_odom_keyframe_;
}
cv::Mat Odometry::keyframeImage() const {
  return implementation_->keyframe_.image().clone();
}

std::vector<CloudPoint> Odometry::keyframeCloud() const {
  const Implementation& self = *implementation_;
  if (!self.has_keyframe_) return {};
  return makeCloud(self.keyframe_, self.camera_);
}

cv::Mat Odometry::residualImage() const {
  const Implementation& self = *implementation_;
  if (!self.has_keyframe_) return {};
  return makeResidualImage(self.keyframe_, self.live_.grey(0), self.camera_,
                           self.result_.T_odom_camera.inverse() * self.T_odom_keyframe_);
}

}  // namespace mivo
