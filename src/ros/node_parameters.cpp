// SPDX-License-Identifier: BSD-3-Clause
#include "ros/node_parameters.h"

#include "mivo/core/error.h"
#include "ros/ros_parameter.h"

namespace mivo {
namespace {

constexpr int kMaxQueueSize = 10000;
constexpr int kMaxPoses = 100000000;
constexpr double kMaxTolerance = 1.0;  // s

/// Calls visitor(name, member) with a member and what bounds it, for all parameters.
template <typename Visitor>
void visit(NodeParameters& p, Visitor&& visitor) {
  visitor("odom_frame", p.odom_frame);
  visitor("base_frame", p.base_frame);
  visitor("publish_tf", p.publish_tf);
  visitor("two_d_mode", p.two_d_mode);
  visitor("publish_when_lost", p.publish_when_lost);
  visitor("guess_frame_id", p.guess_frame_id);
  visitor("required", p.required);
  visitor("tf_timeout", p.tf_timeout, 0.0, kMaxTolerance);
  visitor("rgb_transport", p.rgb_transport);
  visitor("depth_transport", p.depth_transport);
  visitor("depth_registered", p.depth_registered);
  visitor("queue_size", p.queue_size, 1, kMaxQueueSize);
  visitor("approximate_sync", p.approximate_sync);
  visitor("sync_tolerance", p.sync_tolerance, 0.0, kMaxTolerance);
  visitor("drop_frames", p.drop_frames);
  visitor("path_length", p.path_length, 1, kMaxPoses);
  visitor("trajectory_length", p.trajectory_length, 1, kMaxPoses);
  visitor("trajectory_folder", p.trajectory_folder);
  visitor("trajectory_file", p.trajectory_file);
  visitor("trajectory_force", p.trajectory_force);
  visitor("write_lost", p.write_lost);
}

/// tf2 knows frames without a leading slash only.
void stripSlash(std::string& frame) {
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
}

}  // namespace

NodeParameters readNodeParameters(const ros::NodeHandle& node) {
  NodeParameters parameters;
  visit(parameters, [&](const char* name, auto& value, auto... bounds) {
    readParameter(node, name, value, bounds...);
  });
  stripSlash(parameters.odom_frame);
  stripSlash(parameters.base_frame);
  stripSlash(parameters.guess_frame_id);
  const std::string& registered = parameters.depth_registered;
  if (registered != "auto" && registered != "yes" && registered != "no") {
    throw Error("parameter '" + node.resolveName("depth_registered") + "' is '" + registered +
                "', expected auto, yes or no");
  }
  if (parameters.odom_frame.empty() || parameters.base_frame.empty()) {
    throw Error("parameters '" + node.resolveName("odom_frame") + "' and '" +
                node.resolveName("base_frame") + "' must not be empty");
  }
  if (parameters.odom_frame == parameters.base_frame ||
      parameters.odom_frame == parameters.guess_frame_id ||
      parameters.base_frame == parameters.guess_frame_id) {
    throw Error("parameters odom_frame '" + parameters.odom_frame + "', base_frame '" +
                parameters.base_frame + "' and guess_frame_id '" + parameters.guess_frame_id +
                "' of " + node.getNamespace() + " must differ from each other");
  }
  return parameters;
}

std::vector<std::string> nodeParameterNames() {
  // Read by diagnostic_updater, by image_transport, and by the pool of a stand-alone node.
  std::vector<std::string> names = {"diagnostic_period", "image_transport", "num_worker_threads"};
  NodeParameters parameters;
  visit(parameters, [&](const char* name, auto&, auto...) { names.emplace_back(name); });
  return names;
}

}  // namespace mivo
