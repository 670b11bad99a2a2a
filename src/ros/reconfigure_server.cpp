// SPDX-License-Identifier: BSD-3-Clause
#include "ros/reconfigure_server.h"

#include <mivo/OdometryConfig.h>
#include <ros/console.h>

#include <utility>

#include "ros/parameter_server.h"

namespace mivo {

ReconfigureServer::ReconfigureServer(const ros::NodeHandle& private_node,
                                     const Parameters& parameters,
                                     std::function<void(const Parameters&)> apply)
    : node_(private_node), parameters_(parameters), apply_(std::move(apply)) {
  // The names are those of dynamic_reconfigure's protocol.
  descriptions_ =
      node_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  updates_ = node_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  descriptions_.publish(OdometryConfig::__getDescriptionMessage__());
  updates_.publish(toConfig(parameters_));
  writeParameters(node_, parameters_);
  service_ = node_.advertiseService("set_parameters", &ReconfigureServer::change, this);
}

bool ReconfigureServer::change(dynamic_reconfigure::Reconfigure::Request& request,
                               dynamic_reconfigure::Reconfigure::Response& response) {
  // An exception reaches the client as the text of its own error, and roscpp logs it here.
  const Parameters wanted = changed(parameters_, request.config);
  apply_(wanted);
  parameters_ = wanted;
  response.config = toConfig(parameters_);
  updates_.publish(response.config);
  writeParameters(node_, parameters_);
  return true;
}

}  // namespace mivo
