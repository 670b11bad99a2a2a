// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <opencv2/rgbd/depth.hpp>
#include <string>

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"
#include "undistorter.h"

namespace mivo {

/// The odometries of OpenCV's contributed module rgbd.
enum class Peer { kRgbd, kIcp, kRgbdIcp };

/// Throws Error for anything but rgbd, icp and rgbd_icp.
Peer toPeer(const std::string& name);

/// One of OpenCV's odometries from frame to frame with its default settings, the way its own
/// evaluation program drives it: what was prepared of a frame is used again for the next one.
class PeerOdometry {
 public:
  PeerOdometry(Peer peer, const Camera& camera);

  /// Tracks a frame; false when OpenCV reports failure, the pose is then the last one. The first
  /// frame defines the world.
  bool process(const Frame& frame);

  const Eigen::Isometry3d& T_odom_camera() const { return T_odom_camera_; }

  /// Processor time that undistorting the last frame took, milliseconds; 0 without distortion.
  double undistortionMilliseconds() const { return undistortion_milliseconds_; }

 private:
  cv::Ptr<cv::rgbd::OdometryFrame> prepare(const Frame& frame);

  Undistorter undistorter_;
  cv::Ptr<cv::rgbd::Odometry> odometry_;
  cv::Ptr<cv::rgbd::OdometryFrame> previous_;
  Eigen::Isometry3d T_odom_camera_ = Eigen::Isometry3d::Identity();
  double undistortion_milliseconds_ = 0.0;
};

}  // namespace mivo
