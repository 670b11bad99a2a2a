// SPDX-License-Identifier: BSD-3-Clause
#include "peer_odometry.h"

#include <limits>

#include "core/execution/cpu_clock.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

cv::Ptr<cv::rgbd::Odometry> makeOdometry(Peer peer, const Camera& camera) {
  const cv::Mat matrix(cameraMatrix(camera));
  switch (peer) {
    case Peer::kRgbd:
      return cv::rgbd::RgbdOdometry::create(matrix);
    case Peer::kIcp:
      return cv::rgbd::ICPOdometry::create(matrix);
    case Peer::kRgbdIcp:
      return cv::rgbd::RgbdICPOdometry::create(matrix);
  }
  throw Error("peer: not one of rgbd, icp, rgbd_icp");
}

}  // namespace

Peer toPeer(const std::string& name) {
  if (name == "rgbd") return Peer::kRgbd;
  if (name == "icp") return Peer::kIcp;
  if (name == "rgbd_icp") return Peer::kRgbdIcp;
  throw Error("method \"" + name + "\" is not one of rgbd, icp, rgbd_icp");
}

PeerOdometry::PeerOdometry(Peer peer, const Camera& camera)
    : undistorter_(camera), odometry_(makeOdometry(peer, camera)) {}

cv::Ptr<cv::rgbd::OdometryFrame> PeerOdometry::prepare(const Frame& frame) {
  const double start = threadMilliseconds();
  const cv::Mat image = undistorter_.image(frame.image);
  const cv::Mat raw = undistorter_.depth(frame.depth);
  undistortion_milliseconds_ = undistorter_.isNeeded() ? threadMilliseconds() - start : 0.0;
  cv::Mat meters;
  raw.convertTo(meters, CV_32FC1, raw.type() == CV_16UC1 ? frame.depth_unit : 1.0);
  meters.setTo(std::numeric_limits<float>::quiet_NaN(), raw == 0);
  return cv::rgbd::OdometryFrame::create(image, meters);
}

bool PeerOdometry::process(const Frame& frame) {
  cv::Ptr<cv::rgbd::OdometryFrame> live = prepare(frame);
  bool is_tracked = true;
  if (previous_) {
    cv::Mat motion;  // T_previous_live
    is_tracked = odometry_->compute(live, previous_, motion);
    if (is_tracked) {
      Eigen::Matrix4d T;
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) T(row, column) = motion.at<double>(row, column);
      }
      is_tracked = T.allFinite();
      if (is_tracked) T_odom_camera_ = T_odom_camera_ * Eigen::Isometry3d(T);
    }
  }
  previous_ = live;
  return is_tracked;
}

}  // namespace mivo
