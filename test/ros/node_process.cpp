// SPDX-License-Identifier: BSD-3-Clause
#include "ros/node_process.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpc.h>

#include <cstdint>
#include <stdexcept>

namespace mivo {

pid_t processOf(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::master::execute("lookupNode", request, response, uri, false) ||
      !ros::network::splitURI(uri, host, port)) {
    throw std::runtime_error("no node " + node);
  }
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue name;
  name[0] = ros::this_node::getName();
  if (!client.execute("getPid", name, response)) throw std::runtime_error(node + " is silent");
  return static_cast<int>(response[2]);
}

}  // namespace mivo
