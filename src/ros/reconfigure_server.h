// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>

#include "mivo/core/parameters.h"

namespace mivo {

/// dynamic_reconfigure server of the tracker's parameters. The standard server silently clamps
/// values that are out of range; this one rejects the whole request and reports why.
class ReconfigureServer {
 public:
  /// @param apply  called with the new, valid parameters; called by the queue of the node
  /// handle
  ReconfigureServer(const ros::NodeHandle& private_node, const Parameters& parameters,
                    std::function<void(const Parameters&)> apply);

 private:
  bool change(dynamic_reconfigure::Reconfigure::Request& request,
              dynamic_reconfigure::Reconfigure::Response& response);

  ros::NodeHandle node_;
  Parameters parameters_;
  std::function<void(const Parameters&)> apply_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace mivo
