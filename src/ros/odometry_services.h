// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mivo/SaveTrajectory.h>
#include <mivo/SetPose.h>
#include <ros/node_handle.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <Eigen/Geometry>
#include <string>

namespace mivo {

/// Actions of the services. Each may throw Error, whose text becomes the response.
class OdometryActions {
 public:
  virtual ~OdometryActions() = default;
  virtual void reset() = 0;
  virtual void setPose(const Eigen::Isometry3d& T_odom_base) = 0;
  virtual void setPaused(bool paused) = 0;
  /// Returns the path of the file, and sets the number of its poses.
  virtual std::string saveTrajectory(const std::string& path, bool force, std::size_t& poses) = 0;
};

/// The services ~reset, ~set_pose, ~pause and ~save_trajectory.
class OdometryServices {
 public:
  OdometryServices(const ros::NodeHandle& private_node, OdometryActions& actions);

 private:
  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool setPose(SetPose::Request& request, SetPose::Response& response);
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool saveTrajectory(SaveTrajectory::Request& request, SaveTrajectory::Response& response);

  OdometryActions& actions_;
  ros::ServiceServer reset_;
  ros::ServiceServer set_pose_;
  ros::ServiceServer pause_;
  ros::ServiceServer save_trajectory_;
};

}  // namespace mivo
