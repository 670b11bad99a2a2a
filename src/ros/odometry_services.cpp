// SPDX-License-Identifier: BSD-3-Clause
#include "ros/odometry_services.h"

#include <cstdint>

#include "mivo/core/error.h"
#include "ros/pose_conversion.h"
#include "ros/topics.h"

namespace mivo {
namespace {

/// Runs an action; its text, or the error's, becomes the message. The call itself always succeeds:
/// a caller learns the reason from the response only then.
template <typename Response, typename Action>
bool answer(Response& response, Action&& action) {
  try {
    response.message = action();
    response.success = true;
  } catch (const std::exception& error) {  // not an Error: of the file system
    response.message = error.what();
    response.success = false;
  }
  return true;
}

}  // namespace

OdometryServices::OdometryServices(const ros::NodeHandle& private_node, OdometryActions& actions)
    : actions_(actions) {
  ros::NodeHandle node(private_node);
  reset_ = node.advertiseService(topics::kReset, &OdometryServices::reset, this);
  set_pose_ = node.advertiseService(topics::kSetPose, &OdometryServices::setPose, this);
  pause_ = node.advertiseService(topics::kPause, &OdometryServices::pause, this);
  save_trajectory_ =
      node.advertiseService(topics::kSaveTrajectory, &OdometryServices::saveTrajectory, this);
}

bool OdometryServices::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answer(response, [&] {
    actions_.reset();
    return std::string("the next frame starts at the origin");
  });
}

bool OdometryServices::setPose(SetPose::Request& request, SetPose::Response& response) {
  return answer(response, [&] {
    actions_.setPose(toIsometry(request.pose));
    return std::string();
  });
}

bool OdometryServices::pause(std_srvs::SetBool::Request& request,
                             std_srvs::SetBool::Response& response) {
  const bool paused = request.data != 0;
  return answer(response, [&] {
    actions_.setPaused(paused);
    return std::string(paused ? "paused" : "running");
  });
}

bool OdometryServices::saveTrajectory(SaveTrajectory::Request& request,
                                      SaveTrajectory::Response& response) {
  return answer(response, [&] {
    std::size_t poses = 0;
    const std::string path = actions_.saveTrajectory(request.path, request.force != 0, poses);
    response.poses = static_cast<std::uint32_t>(poses);
    return path;
  });
}

}  // namespace mivo
