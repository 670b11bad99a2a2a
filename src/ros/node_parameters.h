// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "ros/topics.h"
#include "session/stamp_pairer.h"

namespace mivo {

/// Parameters of the odometry node other than the tracker's, read once at startup. ROS parameters
/// have the names of the members.
struct NodeParameters {
  std::string odom_frame = frames::kOdometry;  ///< frame of the published poses
  std::string base_frame = frames::kBase;      ///< frame whose pose is published
  bool publish_tf = true;   ///< odom_frame -> base_frame, or -> guess_frame_id when that is set
  bool two_d_mode = false;  ///< published poses stay in the plane z = 0
  bool publish_when_lost = false;  ///< publish the guess of lost frames with variances of 10^4
  std::string guess_frame_id;      ///< frame of another odometry; empty: none
  double tf_timeout = 0.05;        ///< s, wait for the transform of guess_frame_id

  bool required = false;  ///< a nodelet that cannot start fails to load; otherwise it stays idle

  std::string rgb_transport = "raw";  ///< raw, compressed, or any image_transport
  std::string depth_transport =
      "raw";  ///< raw, compressed, compressedDepth, or any image_transport
  std::string depth_registered = "auto";  ///< to color: yes, no, or auto, by frames and topic
  int queue_size = 10;                    ///< messages that wait for their partner, per input
  bool approximate_sync = true;           ///< otherwise the stamps of color and depth must be equal
  double sync_tolerance = kMaxPairDifference;  ///< s, largest difference of the stamps of a pair
  bool drop_frames = true;  ///< track the newest frame; otherwise all wait (for bags), and
                            ///< queue_size is at least 100

  int path_length = 5000;  ///< poses of the path and keyframes shown, the oldest are dropped
  int trajectory_length = 1000000;      ///< poses kept for save_trajectory, the oldest are dropped
  std::string trajectory_folder = ".";  ///< for relative paths of trajectories
  std::string trajectory_file;          ///< written pose by pose while running; empty: none
  bool trajectory_force = false;        ///< an existing trajectory_file is replaced
  bool write_lost = false;              ///< also write the guesses of lost frames
};

/// Throws Error, naming the parameter, for a wrong type, a value out of range, or inconsistent
/// frame names.
NodeParameters readNodeParameters(const ros::NodeHandle& node);

/// Valid private parameters of the node other than the tracker's.
std::vector<std::string> nodeParameterNames();

}  // namespace mivo
