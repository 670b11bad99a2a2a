// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include <string>

namespace mivo {

/// Type of a value in words: "a whole number", "a string".
std::string typeText(const XmlRpc::XmlRpcValue& value);

// Reads a parameter of a node's own name, when it is set. Throws Error, naming it, when it does not
// mean a value of the type: a string does that spells one as a configuration file would.
void readParameter(const ros::NodeHandle& node, const std::string& name, bool& value);
void readParameter(const ros::NodeHandle& node, const std::string& name, std::string& value);

/// Throws Error also when the value is out of the range, both ends included.
void readParameter(const ros::NodeHandle& node, const std::string& name, int& value, int minimum,
                   int maximum);
void readParameter(const ros::NodeHandle& node, const std::string& name, double& value,
                   double minimum, double maximum);

}  // namespace mivo
