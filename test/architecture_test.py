#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fails when a file includes a header of a folder that it may not know (doc/architecture.md), or
when the core reaches for files, printing or ROS.

    test/architecture_test.py            looks at src/ and include/mivo/
    test/architecture_test.py --self     shows that forbidden includes are caught
"""

import os
import re
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))

# The table of doc/architecture.md: what each folder may include besides itself.
MAY_INCLUDE = {
    "core": set(),
    "trajectory": {"core"},
    "session": {"core", "trajectory"},
    "io": {"core", "trajectory", "session"},
    "evaluation": {"core", "trajectory"},
    "synthetic": {"core"},
    "openni2": {"core", "session"},
    "ros": {"core", "trajectory", "session", "io", "evaluation", "synthetic", "openni2"},
    "programs": {"core", "trajectory", "session", "io", "evaluation", "synthetic", "openni2", "ros"},
}

# Headers that are not mivo's, by the folders that may use them.
ROS = re.compile(
    r"^(ros|rosbag|nodelet|pluginlib|tf2?(_ros|_msgs|_eigen|_geometry_msgs)?|cv_bridge|image_transport"
    r"|message_filters|diagnostic_updater|dynamic_reconfigure|camera_info_manager|topic_tools"
    r"|\w+_msgs|std_srvs|mivo)/")
FOREIGN = [
    (ROS, {"ros", "programs"}, "ROS"),
    (re.compile(r"^(OpenNI|openni2/|PS1080)"), {"openni2"}, "the OpenNI2 SDK"),
    (re.compile(r"^yaml-cpp/"), {"io", "evaluation", "synthetic", "ros", "programs"}, "yaml-cpp"),
    (re.compile(r"^opencv2/(imgcodecs|highgui|videoio)"),
     {"io", "evaluation", "synthetic", "ros", "programs"}, "image files and windows"),
    (re.compile(r"^(iostream|fstream|filesystem|cstdio|stdio\.h|fmt/)"),
     {"io", "evaluation", "synthetic", "openni2", "ros", "programs"}, "files and printing"),
    (re.compile(r"^boost/program_options"), {"programs"}, "the command line"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<][^">]+)[">]')


def includes_of(path):
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, start=1):
            match = INCLUDE.match(line)
            if match:
                yield number, match.group(1)


def included_folder(quoted, header):
    """The folder of mivo that a header belongs to, or nothing."""
    parts = header.split("/")
    if parts[0] == "mivo":
        return parts[1] if len(parts) > 2 else None  # mivo/X.h: made from a message
    return parts[0] if quoted and len(parts) > 1 and parts[0] in MAY_INCLUDE else None


def faults_in(root):
    faults = []
    count = 0
    for top in ("include/mivo", "src"):
        base = os.path.join(root, top)
        for directory, _, names in sorted(os.walk(base)):
            relative = os.path.relpath(directory, base)
            folder = relative.split(os.sep)[0]
            for name in sorted(names):
                if not name.endswith((".h", ".cpp", ".def")):
                    continue
                count += 1
                path = os.path.join(directory, name)
                shown = os.path.relpath(path, root)
                if folder not in MAY_INCLUDE:
                    faults.append(f"{shown}: folder '{folder}' is not in the table")
                    continue
                for line, header in includes_of(path):
                    faults += [f"{shown}:{line}: {fault}" for fault in faults_of(folder, header)]
    return count, faults


def faults_of(folder, include):
    header = include[1:]
    other = included_folder(include[0] == '"', header)
    if other is None:
        for pattern, allowed, what in FOREIGN:
            if pattern.match(header) and folder not in allowed:
                yield f"{folder} may not use {what}, but includes {header}"
    elif other not in MAY_INCLUDE:
        yield f"includes {header}, of a folder that is not in the table"
    elif other != folder and other not in MAY_INCLUDE[folder]:
        yield f"{folder} may not know {other}, but includes {header}"


def expect(folder, include, is_fault):
    """One file with one include, looked at as the whole tree would be."""
    with tempfile.TemporaryDirectory() as root:
        directory = os.path.join(root, "src", folder)
        os.makedirs(directory)
        os.makedirs(os.path.join(root, "include/mivo"))
        end = ">" if include[0] == "<" else '"'
        with open(os.path.join(directory, "file.cpp"), "w", encoding="utf-8") as file:
            file.write(f"// text\n#include {include}{end}\n")
        count, faults = faults_in(root)
        if count != 1 or bool(faults) != is_fault:
            sys.exit(f"self-check: {folder} including {include[1:]}: expected "
                     f"{'a fault' if is_fault else 'none'}, got {faults}")


def check_self():
    for folder, include in [
            ("core", '"mivo/io/frame_source.h'), ("core", "<ros/ros.h"), ("core", "<iostream"),
            ("core", "<mivo/TrackingStatus.h"), ("core", "<opencv2/imgcodecs.hpp"),
            ("io", '"evaluation/report.h'), ("io", "<sensor_msgs/Image.h"),
            ("evaluation", '"mivo/io/trajectory_io.h'), ("synthetic", '"ros/bag_writer.h'),
            ("openni2", "<ros/console.h"), ("ros", "<OpenNI.h"),
            ("ros", '"programs/command_line.h'), ("io", '"mivo/nowhere/x.h'),
            ("nowhere", "<vector")]:
        expect(folder, include, True)
    for folder, include in [
            ("core", '"mivo/core/frame.h'), ("core", "<opencv2/imgproc.hpp"),
            ("core", "<Eigen/Core"), ("core", '"core/kernels/scalar.h'), ("io", '"mivo/core/frame.h'),
            ("io", "<fstream"), ("ros", '"openni2/camera_thread.h'), ("ros", "<ros/ros.h"),
            ("ros", "<mivo/OdometryConfig.h"), ("openni2", "<openni2/OpenNI.h"),
            ("programs", '"ros/bag_source.h'), ("programs", '"programs/command_line.h'),
            ("programs", "<boost/program_options.hpp")]:
        expect(folder, include, False)


def main():
    check_self()
    if sys.argv[1:] == ["--self"]:
        print("forbidden includes are caught")
        return
    count, faults = faults_in(ROOT)
    for fault in faults:
        print(fault)
    if count < 50:
        sys.exit(f"only {count} files found below {ROOT}: is this the repository?")
    if faults:
        sys.exit(f"{len(faults)} includes against doc/architecture.md")
    print(f"{count} files keep to doc/architecture.md")


if __name__ == "__main__":
    main()
