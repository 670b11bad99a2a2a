// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "mivo/core/odometry.h"

namespace mivo {

/// The odometry of one camera over resets, jumps of time and changes of the calibration: keeps the
/// pose, and numbers segments and keyframes through. Its world is the first camera pose.
class TrackingSession {
 public:
  explicit TrackingSession(const Parameters& parameters) : parameters_(parameters) {}

  /// Whether the calibration is another one than before: tracking starts anew at the last pose
  /// then. Throws Error for an invalid camera.
  bool setCamera(const Camera& camera);
  bool hasCamera() const { return odometry_ != nullptr; }

  /// Tracks a frame, from `start` when there is one. A camera must have been set.
  const TrackingResult& process(const Frame& frame, const Eigen::Isometry3d* start);

  /// Starts anew at the last pose; stamps may begin anywhere.
  void restart();

  /// Starts anew at the origin.
  void reset();

  /// Throws Error and changes nothing when a value is invalid.
  void setParameters(const Parameters& parameters);
  const Parameters& parameters() const { return parameters_; }

  const TrackingResult& result() const { return result_; }

  /// Covariance of result().velocity, in the axes of the camera.
  const Matrix6& twistCovariance() const { return twist_covariance_; }

  /// For display. A camera must have been set.
  const Odometry& odometry() const { return *odometry_; }

 private:
  void startSegment();

  Parameters parameters_;
  std::unique_ptr<Odometry> odometry_;
  TrackingResult result_;
  Matrix6 twist_covariance_ = Matrix6::Identity();
  bool has_result_ = false;
  bool segment_is_new_ = false;  // the next result begins one
  int segment_offset_ = 0;       // number of a segment minus the odometry's own
  int keyframe_offset_ = 0;
};

}  // namespace mivo
