#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A bad launch argument ends the launch at once, with exit code 1 and a line that names the argument;
what only the node can find ends it, too, where the launch file cannot do without the node.

    run_with_ros BUILD_FOLDER /usr/bin/python3 launch_faults_test.py BUILD_FOLDER
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

import rosbag
import roslaunch
from sensor_msgs.msg import CameraInfo, Image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
CHECK = os.path.join(ROOT, "launch", "check_arguments")
TOPICS = ("/camera/rgb/image_raw", "/camera/rgb/camera_info", "/camera/depth_registered/image_raw")
BUILD = os.path.realpath(sys.argv[1])


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.bag = self.path("any.bag")
        with rosbag.Bag(self.bag, "w") as bag:
            for topic in TOPICS:
                bag.write(topic, CameraInfo() if topic.endswith("info") else Image())
        self.taken = self.write("taken.txt", "poses\n")

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="latin-1") as file:
            file.write(text)
        return self.path(name)

    def launch(self, *arguments, limit=10):
        """Ends within the limit, in seconds, or the test fails. rosbag's player, which waits for its
        subscribers, does not hear SIGINT: roslaunch would wait for it for 15 s."""
        return subprocess.run(
            [os.path.join(ROOT, "test/ros/run_with_ros"), BUILD, "roslaunch", "--port", "0",
             "--sigint-timeout=1", "mivo", *arguments], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
            cwd=self.folder, timeout=limit,
            env={**os.environ, "PWD": self.folder, "ROS_HOME": self.path("ros")})


class LaunchFaultsTest(Case):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def expect_refusal(self, line, launch, *arguments):
        """Reads the launch file as roslaunch does before it starts anything."""
        with tempfile.TemporaryFile("w+") as errors:
            stderr = os.dup(2)
            os.dup2(errors.fileno(), 2)
            try:
                with self.assertRaises(Exception):
                    roslaunch.xmlloader.XmlLoader().load(
                        os.path.join(ROOT, "launch", launch), roslaunch.ROSLaunchConfig(),
                        argv=[*arguments, "rviz:=false"], verbose=False)
            finally:
                os.dup2(stderr, 2)
                os.close(stderr)
            errors.seek(0)
            self.assertRegex(errors.read(), "^mivo: launch argument " + re.escape(line) + ".*\n$")

    def test_roslaunch_ends_at_once(self):
        """What bag.launch may be given wrongly, by the command itself: no message of the node, but one
        line with the argument to change."""
        missing = self.path("missing")
        for arguments, line in (
                (["output:=taken.txt"],
                 "'output' is '%s', which exists: force:=true replaces it" % self.taken),
                (["output:=missing/run.txt"],
                 "'output' is '%s/run.txt', but there is no folder '%s': create it first" % (missing, missing)),
                (["method:=foo"], "'method' is 'foo', expected hybrid, mi, ssd"),
                (["rate:=fast"], "'rate' is 'fast', expected a number above 0")):
            with self.subTest(arguments=arguments):
                result = self.launch("bag.launch", "bag:=any.bag", "rviz:=false", *arguments)
                self.assertEqual(1, result.returncode, result.stdout)
                told = [said for said in result.stdout.splitlines() if said.startswith("mivo: ")]
                self.assertEqual(["mivo: launch argument " + line], told)

    def test_an_existing_output_needs_force(self):
        line = "'output' is '%s', which exists: force:=true replaces it" % self.taken
        self.expect_refusal(line, "bag.launch", "bag:=" + self.bag, "output:=" + self.taken)
        self.expect_refusal(line, "bag.launch", "bag:=any.bag", "output:=taken.txt")
        self.expect_refusal(line, "odometry.launch", "output:=" + self.taken)
        self.expect_refusal(line, "xtion.launch", "output:=" + self.taken)
        self.expect_refusal(line, "demo.launch", "bag:=" + self.bag, "output_ssd:=" + self.taken)
        with open(self.taken, encoding="utf-8") as file:
            self.assertEqual("poses\n", file.read())

    def test_a_missing_folder_is_told(self):
        missing = self.path("missing/run.txt")
        line = "'output' is '%s', but there is no folder '%s': create it first" % (
            missing, self.path("missing"))
        for launch in (("bag.launch", "bag:=" + self.bag), ("odometry.launch",), ("xtion.launch",)):
            self.expect_refusal(line, *launch, "output:=" + missing, "force:=true")
        self.expect_refusal(line.replace("'output'", "'bag'"), "record.launch", "bag:=" + missing)

    def test_unknown_words_are_told_with_the_known(self):
        methods = "'method' is 'foo', expected hybrid, mi, ssd"
        self.expect_refusal(methods, "bag.launch", "bag:=" + self.bag, "method:=foo")
        self.expect_refusal(methods, "xtion.launch", "method:=foo")
        self.expect_refusal("'layout' is 'kinect', expected auto, openni2, tum, rtabmap, realsense",
                            "bag.launch", "bag:=" + self.bag, "layout:=kinect")
        self.expect_refusal("'driver' is 'freenect', expected mivo, openni2_launch", "xtion.launch",
                            "driver:=freenect")

    def test_wrong_types_are_told(self):
        bag = ("bag.launch", "bag:=" + self.bag)
        self.expect_refusal("'force' is 'maybe', expected true or false", *bag, "force:=maybe")
        self.expect_refusal("'rate' is '0', expected a number above 0", *bag, "rate:=0")
        self.expect_refusal("'delay' is 'nan', expected a number, 0 or more", *bag, "delay:=nan")
        self.expect_refusal("'queue_size' is '2.5', expected a whole number, 1 or more",
                            "odometry.launch", "queue_size:=2.5")
        self.expect_refusal("'write_lost' is 'maybe', expected true or false", "odometry.launch",
                            "write_lost:=maybe")
        self.expect_refusal("'duration' is 'long', expected a number, 0 or more", "record.launch",
                            "duration:=long")

    def test_missing_inputs_are_told(self):
        self.expect_refusal("'bag' is '%s', but there is no such file" % self.path("no.bag"),
                            "bag.launch", "bag:=no.bag")
        self.expect_refusal("'bag' must be given", "bag.launch")
        self.expect_refusal("'config' is '%s', which is a folder, not a file" % self.folder,
                            "xtion.launch", "config:=" + self.folder)

    def test_topics_that_are_not_in_the_bag_are_told(self):
        line = "'bag' is '%s': the bag has no images on the topic %s; image and camera_info topics of " \
            "the bag: " + ", ".join(sorted(TOPICS))
        self.expect_refusal(line % (self.bag, "/camera/rgb/image_color"), "bag.launch",
                            "bag:=" + self.bag, "layout:=tum")
        self.expect_refusal(line % ("any.bag", TOPICS[2] + "/compressedDepth"), "bag.launch",
                            "bag:=any.bag", "layout:=openni2", "depth_transport:=compressedDepth")

    def test_what_is_no_bag_is_told(self):
        self.expect_refusal("'bag' is '%s': %s cannot be read as a bag: it is no bag" % (
            self.taken, self.taken), "bag.launch", "bag:=" + self.taken)
        mcap = self.write("x.mcap", "\x89MCAP0\r\n")
        self.expect_refusal("'bag' is '%s': %s cannot be read as a bag: it is a recording of ROS 2" % (
            mcap, mcap), "bag.launch", "bag:=" + mcap)
        self.expect_refusal("'bag' is '%s', but there is no such file" % self.path("no.bag"),
                            "bag.launch", "bag:=any.bag no.bag")
        with open(self.bag, "rb") as file:
            begin = self.path("begin.bag")
            with open(begin, "wb") as cut:
                cut.write(file.read()[:20])
        self.expect_refusal("'bag' is '%s': %s cannot be read as a bag: its index is damaged or missing" % (
            begin, begin), "bag.launch", "bag:=" + begin)

    def test_frames_must_differ(self):
        self.expect_refusal("'base_frame' is 'odom', which is also the frame of 'odom_frame'", "bag.launch",
                            "bag:=" + self.bag, "base_frame:=/odom")


class RefusedByTheNodeTest(Case):
    def setUp(self):
        super().setUp()
        self.config = self.write("config.yaml", "mi_bins: 1000\n")
        subprocess.run([os.path.join(BUILD, "bin/generate_sequence"), self.path("sequence"),
                        "--frames", "2", "--width", "160", "--height", "120", "--depth-units", "1000"],
                       check=True, stdout=subprocess.DEVNULL)
        os.remove(self.bag)
        subprocess.run([os.path.join(BUILD, "bin/sequence_to_bag"), self.path("sequence"), self.bag,
                        "--layout", "openni2"],
                       check=True, stdout=subprocess.DEVNULL)

    def expect_end(self, *arguments):
        result = self.launch(*arguments, "rviz:=false", limit=20)
        told = [line for line in result.stdout.splitlines() if "cannot start: " in line]
        self.assertEqual(1, len(told), result.stdout)
        self.assertIn("mi_bins", told[0])
        self.assertIn("REQUIRED process", result.stdout)

    def test_bag_launch_ends(self):
        self.expect_end("bag.launch", "bag:=" + self.bag, "config:=" + self.config)

    def test_demo_launch_ends_though_its_manager_lives(self):
        self.expect_end("demo.launch", "bag:=" + self.bag, "config:=" + self.config)


class CheckArgumentsTest(Case):
    def check(self, *arguments):
        return subprocess.run([CHECK, *arguments], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False)

    def test_good_values_say_yes(self):
        result = self.check("output=output=" + self.taken, "force=switch=true",
                            "rate=rate=0.5", "odom_frame=frame=odom",
                            "guess_frame_id=optional_frame=", "base_frame=frame=base",
                            "bag=replaced=" + self.taken, "empty=output=", "duration=optional_number=")
        self.assertEqual((0, "yes", ""), (result.returncode, result.stdout, result.stderr))

    def test_frames_need_a_name(self):
        self.assertEqual("mivo: launch argument 'base_frame' must not be empty\n",
                         self.check("base_frame=frame=").stderr)

    def test_one_line_is_said(self):
        result = self.check("a=number=x", "b=number=y")
        self.assertEqual((1, "", "mivo: launch argument 'a' is 'x', expected a number, 0 or more\n"),
                         (result.returncode, result.stdout, result.stderr))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
