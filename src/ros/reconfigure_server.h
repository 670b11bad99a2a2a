// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>

#include "mivo/core/parameters.h"

namespace mivo {

/// The tracker's parameters for the clients of dynamic_reconfigure. Its own server silently moves a
/// value that is out of range to the nearest bound; here the whole request is refused, and the
/// client is told why.
class ReconfigureServer {
 public:
  /// @param apply  takes over the parameters, which are valid; called by the queue of the node
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
