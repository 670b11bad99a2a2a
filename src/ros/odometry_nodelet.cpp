// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <ros/this_node.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "ros/odometry_node.h"

namespace mivo {

/// The odometry in a nodelet manager, or alone (odometry_node). With invalid parameters it stays
/// idle and reports why in the log and on /diagnostics; other nodelets of the manager are not
/// affected. With `required` it fails to load.
class OdometryNodelet : public nodelet::Nodelet {
 public:
  ~OdometryNodelet() override {
    fault_timer_.stop();
    node_.reset();
  }

 private:
  void onInit() override {
    diagnostics_ =
        std::make_unique<OdometryDiagnostics>(getNodeHandle(), getPrivateNodeHandle(), getName());
    try {
      node_ =
          std::make_unique<OdometryNode>(getNodeHandle(), getPrivateNodeHandle(), *diagnostics_);
    } catch (const std::exception& error) {  // no exception may end the nodelet manager
      if (getPrivateNodeHandle().param("required", false)) {
        NODELET_ERROR_STREAM("cannot start: " << error.what());
        // Alone in its process it ends that at once: the loader would unload this library under the
        // exception that comes out of it, and crash.
        if (getName() == ros::this_node::getName()) std::_Exit(1);
        throw;  // the manager refuses to load it
      }
      NODELET_ERROR_STREAM("idle: " << error.what());
      diagnostics_->setFault(error.what());
      fault_timer_ = getNodeHandle().createWallTimer(
          ros::WallDuration(1.0),
          [this](const ros::WallTimerEvent&) { diagnostics_->publish({}, {}, 0); });
    }
  }

  std::unique_ptr<OdometryDiagnostics> diagnostics_;
  std::unique_ptr<OdometryNode> node_;
  ros::WallTimer fault_timer_;
};

}  // namespace mivo

PLUGINLIB_EXPORT_CLASS(mivo::OdometryNodelet, nodelet::Nodelet)
