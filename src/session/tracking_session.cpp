// SPDX-License-Identifier: BSD-3-Clause
#include "session/tracking_session.h"

#include <algorithm>
#include <utility>

#include "core/camera_doubt.h"
#include "session/twist_covariance.h"

namespace mivo {

bool TrackingSession::setCamera(const Camera& camera) {
  if (odometry_ && isSameButForRounding(odometry_->camera(), camera)) return false;
  auto odometry = std::make_unique<Odometry>(camera, parameters_);
  const bool is_change = odometry_ != nullptr;
  if (is_change) {
    keyframe_offset_ += odometry_->result().keyframes;
    odometry->reset(result_.T_odom_camera);
  }
  odometry_ = std::move(odometry);
  if (is_change) startSegment();
  return is_change;
}

/// The next frame begins a segment that none was in before.
void TrackingSession::startSegment() {
  is_last_frame_measured_ = false;
  segment_offset_ = num_segments_ - odometry_->result().segment;
}

void TrackingSession::restart() {
  last_measured_.reset();
  if (!odometry_) return;
  odometry_->reset(result_.T_odom_camera);
  startSegment();
}

void TrackingSession::reset() {
  last_measured_.reset();
  result_.T_odom_camera.setIdentity();
  if (!odometry_) return;
  odometry_->reset();
  startSegment();
}

void TrackingSession::setParameters(const Parameters& parameters) {
  parameters.validate();
  if (odometry_) odometry_->setParameters(parameters);
  parameters_ = parameters;
}

const TrackingResult& TrackingSession::process(const Frame& frame, const Eigen::Isometry3d* start) {
  result_ = start != nullptr ? odometry_->process(frame, *start) : odometry_->process(frame);
  result_.segment += segment_offset_;
  result_.keyframes += keyframe_offset_;
  if (result_.keyframe > 0) result_.keyframe += keyframe_offset_;
  if (!result_.isRefused()) measure();
  return result_;
}

/// The velocity is that between two frames of one segment that follow each other.
void TrackingSession::measure() {
  num_segments_ = std::max(num_segments_, result_.segment + 1);
  const bool continued = is_last_frame_measured_ && last_measured_segment_ == result_.segment;
  twist_covariance_ =
      mivo::twistCovariance(last_alignment_covariance_, result_.alignment_covariance,
                            continued ? result_.stamp - last_measured_->stamp : 0.0);
  is_last_frame_measured_ = result_.isMeasured();
  if (!is_last_frame_measured_) return;
  last_measured_ = StampedPose{result_.stamp, result_.T_odom_camera};
  last_alignment_covariance_ = result_.alignment_covariance;
  last_measured_segment_ = result_.segment;
}

}  // namespace mivo
