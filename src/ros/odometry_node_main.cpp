// SPDX-License-Identifier: BSD-3-Clause
// The odometry without a manager: loads the same nodelet into a process of its own.
#include <nodelet/loader.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include <iostream>
#include <string>

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--help") {  // ros::init waits for a master
    std::cout << "Usage: rosrun mivo odometry_node [_PARAMETER:=VALUE...] [TOPIC:=OTHER...]\n"
                 "Topics, services and parameters: doc/ros.md\n";
    return 0;
  }
  ros::init(argc, argv, "odometry");
  ros::param::set("~required", true);  // an idle node alone would be useless
  nodelet::Loader loader;
  const nodelet::M_string remappings(ros::names::getRemappings());
  const nodelet::V_string arguments(argv + 1, argv + argc);
  if (!loader.load(ros::this_node::getName(), "mivo/OdometryNodelet", remappings, arguments)) {
    std::cerr
        << "odometry_node: cannot load the nodelet mivo/OdometryNodelet, see the reason above; "
           "if there is none, source the workspace's setup.bash, or set CMAKE_PREFIX_PATH and "
           "ROS_PACKAGE_PATH\n";
    return 1;
  }
  ros::spin();
  return 0;
}
