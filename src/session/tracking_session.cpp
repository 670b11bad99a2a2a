// SPDX-License-Identifier: BSD-3-Clause
#include "session/tracking_session.h"

#include "session/twist_covariance.h"

namespace mivo {

bool TrackingSession::setCamera(const Camera& camera) {
  if (odometry_ && odometry_->camera() == camera) return false;
  auto odometry = std::make_unique<Odometry>(camera, parameters_);
  const bool is_change = odometry_ != nullptr;
  if (is_change) {
    keyframe_offset_ += odometry_->result().keyframes;
    odometry->reset(result_.T_odom_camera);
    startSegment();
  }
  odometry_ = std::move(odometry);
  return is_change;
}

void TrackingSession::startSegment() {
  segment_is_new_ = has_result_;
}

void TrackingSession::restart() {
  if (odometry_) odometry_->reset(result_.T_odom_camera);
  startSegment();
}

void TrackingSession::reset() {
  if (odometry_) odometry_->reset();
  startSegment();
  result_.T_odom_camera.setIdentity();
}

void TrackingSession::setParameters(const Parameters& parameters) {
  parameters.validate();
  if (odometry_) odometry_->setParameters(parameters);
  parameters_ = parameters;
}

const TrackingResult& TrackingSession::process(const Frame& frame, const Eigen::Isometry3d* start) {
  const TrackingResult before = result_;
  const TrackingResult& own =
      start != nullptr ? odometry_->process(frame, *start) : odometry_->process(frame);
  if (segment_is_new_) segment_offset_ = before.segment + 1 - own.segment;
  const bool continued = has_result_ && !segment_is_new_;
  segment_is_new_ = false;
  has_result_ = true;
  result_ = own;
  result_.segment += segment_offset_;
  result_.keyframes += keyframe_offset_;
  if (result_.keyframe > 0) result_.keyframe += keyframe_offset_;
  const bool measured = continued && before.segment == result_.segment &&
                        before.state != TrackingState::kLost &&
                        before.state != TrackingState::kInitialising;
  twist_covariance_ =
      mivo::twistCovariance(before.alignment_covariance, result_.alignment_covariance,
                            measured ? result_.stamp - before.stamp : 0.0);
  return result_;
}

}  // namespace mivo
