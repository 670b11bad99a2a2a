// SPDX-License-Identifier: BSD-3-Clause
#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>

#include <exception>
#include <memory>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "ros/openni2_node.h"

namespace mivo {

/// The camera in a nodelet manager, or alone (openni2_node). With invalid parameters it stays idle
/// and reports why in the log and on /diagnostics; other nodelets of the manager are not affected.
class OpenNI2Nodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      node_ = std::make_unique<OpenNi2Node>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {  // no exception may end the nodelet manager
      NODELET_ERROR_STREAM("idle: " << error.what());
      fault_ = error.what();
      updater_ = std::make_unique<diagnostic_updater::Updater>(getNodeHandle(),
                                                               getPrivateNodeHandle(), getName());
      updater_->setHardwareID("none");
      updater_->add("camera", this, &OpenNI2Nodelet::reportFault);
      timer_ = getNodeHandle().createWallTimer(
          ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { updater_->force_update(); });
    }
  }

  void reportFault(diagnostic_updater::DiagnosticStatusWrapper& status) {
    status.summary(diagnostic_msgs::DiagnosticStatus::ERROR, "idle: " + fault_);
  }

  std::unique_ptr<OpenNi2Node> node_;
  std::string fault_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ros::WallTimer timer_;
};

}  // namespace mivo

PLUGINLIB_EXPORT_CLASS(mivo::OpenNI2Nodelet, nodelet::Nodelet)
