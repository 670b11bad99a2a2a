// SPDX-License-Identifier: BSD-3-Clause
#include "ros/odometry_output.h"

#include "mivo/core/error.h"

namespace mivo {

OdometryOutput::OdometryOutput(const ros::NodeHandle& private_node,
                               const NodeParameters& parameters)
    : parameters_(parameters),
      publisher_(private_node, parameters),
      display_(private_node, parameters),
      markers_(private_node, parameters) {}

void OdometryOutput::publishOdometry(const TrackingSession& session, const ros::Time& stamp,
                                     const Eigen::Isometry3d& T_base_camera,
                                     const std::optional<Eigen::Isometry3d>& T_guess_base) {
  T_base_camera_ = T_base_camera;
  if (!T_odom_world_) T_odom_world_ = T_base_camera;  // the first pose of the base
  const TrackingResult& result = session.result();
  if (!result.isMeasured() && !parameters_.publish_when_lost) return;
  BaseOdometry odometry = toBase(result, session.twistCovariance(), *T_odom_world_, T_base_camera);
  if (!result.isMeasured()) {
    odometry.pose_covariance = odometry.twist_covariance = Matrix6::Identity() * kUnknownVariance;
  }
  if (parameters_.two_d_mode) odometry = inPlane(odometry);
  publisher_.publish(odometry, stamp, T_guess_base);
}

void OdometryOutput::publishDisplay(const TrackingSession& session,
                                    const ImageMessageConstPtr& color) {
  if (!T_odom_world_) return;
  display_.publish(session.odometry(), session.result().keyframes, *T_odom_world_, color);
  markers_.add(session.result(), session.odometry().camera(), *T_odom_world_, color->header.stamp);
}

void OdometryOutput::setPose(const Eigen::Isometry3d& T_odom_base, const TrackingSession& session) {
  if (!T_odom_world_) {
    throw Error(
        "no pose has been published yet: no frame has arrived, or tf has no transform to the "
        "camera");
  }
  const Eigen::Isometry3d T_odom_world =
      T_odom_base * T_base_camera_ * session.result().T_odom_camera.inverse();
  const Eigen::Isometry3d T_new_old = T_odom_world * T_odom_world_->inverse();
  T_odom_world_ = T_odom_world;
  publisher_.movePath(T_new_old);
  display_.move(T_new_old);
  markers_.move(T_new_old);
}

void OdometryOutput::reset() {
  T_odom_world_.reset();
  publisher_.clearPath();
  display_.clear();
  markers_.clear();
}

}  // namespace mivo
