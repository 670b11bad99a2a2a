// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/names.h>
#include <ros/node_handle.h>

#include <string>

namespace mivo {

/// Full name of a topic beside a node: `odom` of /robot/odometry is /robot/odom. Relative names
/// would be resolved in the namespace of the nodelet manager (/camera/odom), where remappings of
/// /odom have no effect.
/// @param private_node  handle of the node's own namespace
inline std::string topicBeside(const ros::NodeHandle& private_node, const std::string& topic) {
  const std::string parent = ros::names::parentNamespace(private_node.getNamespace());
  return ros::names::clean(ros::names::append(parent, topic));
}

}  // namespace mivo
