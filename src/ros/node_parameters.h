// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "ros/topics.h"
#include "session/stamp_pairer.h"

namespace mivo {

/// Parameters of the odometry node beside the tracker's: read once, at the start. The name of each
/// ROS parameter is that of the member.
struct NodeParameters {
  std::string odom_frame = frames::kOdometry;  ///< frame of the published poses
  std::string base_frame = frames::kBase;      ///< frame whose pose is published
  bool publish_tf = true;   ///< odom_frame -> base_frame, or -> guess_frame_id when that is set
  bool two_d_mode = false;  ///< published poses stay in the plane z = 0
  bool publish_when_lost = false;  ///< also when lost: the guess, with a variance of "unknown"
  std::string
      guess_frame_id;  ///< frame of another odometry that says where the base went; empty: none
  double tf_timeout = 0.05;  ///< s, to wait for a transform of the guess

  bool required = false;  ///< a nodelet that cannot start fails to load; otherwise it stays idle

  std::string rgb_transport = "raw";      ///< raw, compressed, or any that image_transport knows
  std::string depth_transport = "raw";    ///< raw, compressed, compressedDepth, or any other
  std::string depth_registered = "auto";  ///< to colour: yes, no, or auto, by frames and topic
  int queue_size = 10;                    ///< messages that wait for their partner, per input
  bool approximate_sync = true;  ///< otherwise the stamps of colour and depth must be equal
  double sync_tolerance = kMaxPairDifference;  ///< s, largest difference of the stamps of a pair
  bool drop_frames = true;  ///< the newest frame wins; otherwise all wait (for bags), and
                            ///< queue_size is 100 at least

  int path_length = 5000;  ///< poses of the path and keyframes shown, the oldest are dropped
  int trajectory_length = 1000000;      ///< poses kept for save_trajectory, the oldest are dropped
  std::string trajectory_folder = ".";  ///< for relative paths of trajectories
  std::string trajectory_file;          ///< written pose by pose while it runs; empty: none
  bool trajectory_force = false;        ///< an existing trajectory_file is replaced
  bool write_lost = false;              ///< trajectories have the guesses of lost frames, too
};

/// Throws Error, naming the parameter, for a wrong type, a value out of range, or frames that
/// contradict each other.
NodeParameters readNodeParameters(const ros::NodeHandle& node);

/// Names that are no mistake under the private name of the node, beside the tracker's.
std::vector<std::string> nodeParameterNames();

}  // namespace mivo
