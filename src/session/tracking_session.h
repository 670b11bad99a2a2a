// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "mivo/core/odometry.h"
#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// The odometry of one camera across resets, jumps of time and changes of the calibration. Keeps
/// the pose and continues the numbering of segments and keyframes. The world is the first camera
/// pose.
class TrackingSession {
 public:
  explicit TrackingSession(const Parameters& parameters) : parameters_(parameters) {}

  /// Whether the calibration is another one than before, by more than rounding: tracking starts
  /// anew at the last pose then. Throws Error for an invalid camera.
  bool setCamera(const Camera& camera);
  bool hasCamera() const { return odometry_ != nullptr; }

  /// Tracks a frame, starting at `start` if given: the pose by another odometry, see
  /// lastMeasured(). Precondition: a camera was set.
  const TrackingResult& process(const Frame& frame, const Eigen::Isometry3d* start);

  /// Restarts at the last pose; stamps may start at any time.
  void restart();

  /// Restarts at the origin.
  void reset();

  /// Throws Error and changes nothing when a value is invalid.
  void setParameters(const Parameters& parameters);
  const Parameters& parameters() const { return parameters_; }

  const TrackingResult& result() const { return result_; }

  /// The last measured T_odom_camera and its stamp: the origin of a guess by another odometry.
  /// Empty before the first frame and after reset() or restart().
  const std::optional<StampedPose>& lastMeasured() const { return last_measured_; }

  /// Covariance of result().velocity, in the axes of the camera.
  const Matrix6& twistCovariance() const { return twist_covariance_; }

  /// For display. Precondition: a camera was set.
  const Odometry& odometry() const { return *odometry_; }

 private:
  void startSegment();
  void measure();

  Parameters parameters_;
  std::unique_ptr<Odometry> odometry_;
  TrackingResult result_;
  std::optional<StampedPose> last_measured_;
  Matrix6 last_alignment_covariance_ = Matrix6::Identity();  // of last_measured_
  int last_measured_segment_ = 0;                            // of it
  bool is_last_frame_measured_ = false;
  Matrix6 twist_covariance_ = Matrix6::Identity();
  int num_segments_ = 0;    // that had a frame
  int segment_offset_ = 0;  // number of a segment minus the odometry's own
  int keyframe_offset_ = 0;
};

}  // namespace mivo
