// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "mivo/core/parameters.h"

namespace mivo {

/// The parameters of the tracker under the private name of a node; those that are not set keep
/// their defaults. Values mean what they do in a configuration file: a string "1e-4" is a number,
/// "off" a switch. Throws Error, naming the parameter and its range, for what is none of the type
/// or out of range.
Parameters readParameters(const ros::NodeHandle& node);

/// Names under the private name of a node that are neither the tracker's nor among `others`, each
/// as a line that says the nearest known name where one is near. Names with a slash belong to
/// someone else: to a transport or to dynamic_reconfigure, say.
std::vector<std::string> findUnknownParameters(const ros::NodeHandle& node,
                                               const std::vector<std::string>& others);

/// Writes all values in effect to the parameter server.
void writeParameters(const ros::NodeHandle& node, const Parameters& parameters);

/// `parameters` changed by a request of dynamic_reconfigure. Throws Error, as readParameters does,
/// when any of the values is invalid.
Parameters changed(const Parameters& parameters, const dynamic_reconfigure::Config& request);

/// All values as dynamic_reconfigure reports them.
dynamic_reconfigure::Config toConfig(const Parameters& parameters);

}  // namespace mivo
