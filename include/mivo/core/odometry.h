// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"
#include "mivo/core/parameters.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// A point of the keyframe, for display: meters in the keyframe's optical frame, gray 0..255, and
/// its pixel.
struct CloudPoint {
  float x;
  float y;
  float z;
  float intensity;
  int column;
  int row;
};

/// Visual odometry of one camera: each frame is aligned with a keyframe by the hybrid tracker.
/// Not thread-safe; prints nothing and does not throw while tracking.
class Odometry {
 public:
  /// Throws Error for an invalid camera or parameter.
  Odometry(const Camera& camera, const Parameters& parameters);
  ~Odometry();
  Odometry(const Odometry&) = delete;
  Odometry& operator=(const Odometry&) = delete;

  /// Tracks one frame, starting at the predicted pose. Stamps must increase. A frame that does not
  /// match the camera (findFault) or is not newer is refused and changes nothing, see
  /// TrackingResult::isRefused().
  const TrackingResult& process(const Frame& frame);

  /// The same, starting at the given pose instead of the predicted one, if it is one (isRigid).
  const TrackingResult& process(const Frame& frame, const Eigen::Isometry3d& T_odom_camera_start);

  /// Pose predicted by the motion model, which extrapolates for at most half a second.
  Eigen::Isometry3d predictedPose(double stamp) const;

  /// Discards keyframes, motion and stamps; the next frame gets the given pose. Throws Error when
  /// the pose is not one (isRigid), as setPose does.
  void reset(const Eigen::Isometry3d& T_odom_camera = Eigen::Isometry3d::Identity());

  /// Moves the world so that the last pose becomes the given one; tracking is not interrupted.
  void setPose(const Eigen::Isometry3d& T_odom_camera);

  /// Takes effect with the next frame. Throws Error and changes nothing when a value is invalid.
  void setParameters(const Parameters& parameters);
  const Parameters& parameters() const;

  const Camera& camera() const;
  const TrackingResult& result() const;  ///< of the last frame

  bool hasKeyframe() const;
  Eigen::Isometry3d keyframePose() const;         ///< T_odom_keyframe; identity without one
  cv::Mat keyframeImage() const;                  ///< CV_8UC1, a copy; empty without one
  std::vector<CloudPoint> keyframeCloud() const;  ///< every second pixel with depth

  /// Difference live - keyframe at every second pixel with depth, at the last pose, seen in the
  /// keyframe: CV_8UC1 of half the size, 128 where they agree or where nothing is known.
  cv::Mat residualImage() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mivo
