#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a user finds who has sourced a space of mivo, or has installed its Debian package: every program
says by rosrun how it is used, and every node of every launch file has a program to start, and every
nodelet a library to load.

    . SPACE/setup.bash && expect_found.py BAG     BAG in the layout openni2
"""

import ctypes
import glob
import os
import re
import subprocess
import sys
import xml.etree.ElementTree

import roslaunch.config
import roslaunch.core
import roslaunch.node_args
import rospkg

PROGRAMS = ("bag_to_sequence", "check_bag", "evaluate_trajectory", "generate_sequence", "mivo_top",
            "odometry_node", "openni2_node", "play_bag", "relight_sequence", "run_bag", "run_sequence", "sequence_to_bag")
NEEDS_BAG = ("bag.launch", "demo.launch")


def faults_of_program(name):
    result = subprocess.run(["rosrun", "mivo", name, "--help"], text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, check=False, timeout=60)
    if result.returncode != 0 or not re.search(r"^usage: (rosrun mivo )?" + name, result.stdout, re.I | re.M):
        yield "rosrun mivo %s --help ended with %d: %s" % (name, result.returncode, result.stdout)


def faults_of_launch_file(path, bag):
    arguments = ["bag:=" + bag] if os.path.basename(path) in NEEDS_BAG else []
    config = roslaunch.config.load_config_default([(path, arguments)], None, verbose=False,
                                                  assign_machines=False)
    if not config.nodes:
        yield "%s starts nothing" % path
    packages = rospkg.RosPack().list()
    for node in config.nodes:
        if node.package == "rviz" and "rviz" not in packages:
            continue  # recommended, not needed: the others run without it
        try:
            roslaunch.node_args.create_local_process_args(node, roslaunch.core.local_machine())
        except roslaunch.node_args.NodeParamsException as error:
            yield "%s: %s" % (path, error)


def faults_of_nodelets(package):
    for library in xml.etree.ElementTree.parse(os.path.join(package, "nodelet_plugins.xml")).iter("library"):
        try:
            ctypes.CDLL(library.get("path") + ".so")
        except OSError as error:
            yield "nodelet_plugins.xml: %s" % error


def main(bag):
    os.environ.setdefault("ROS_MASTER_URI", "http://localhost:11311")  # named in the files, not asked
    package = rospkg.RosPack().get_path("mivo")
    files = sorted(glob.glob(os.path.join(package, "launch", "*.launch")))
    faults = [] if files else ["no launch files in " + package]
    for name in PROGRAMS:
        faults += faults_of_program(name)
    for path in files:
        faults += faults_of_launch_file(path, bag)
    faults += faults_of_nodelets(package)
    if faults:
        sys.exit("\n".join(faults))
    print("%s: %d programs, %d launch files" % (package, len(PROGRAMS), len(files)))


if __name__ == "__main__":
    main(os.path.realpath(sys.argv[1]))
