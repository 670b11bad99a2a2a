#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every fault that the virtual camera can play: its message, the recovery, and the odometry going on
by itself."""

import os
import sys
import unittest

import rospy
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from virtual_camera import Control, Counter, Listener

PATIENCE = 25  # s: the longest pause between two attempts is 8 s
HEALTHY = {"present": 1, "in_use": 0, "no_permission": 0, "color": 1, "registration": 1, "rate": 30,
           "drop_every": 0, "depth_stalls": 0, "depth_delay": 0}
MAX_PROCESSOR = 5.0  # percent of a core while there is nothing to do but to wait


class FaultsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.control = Control()
        cls.odometry = Counter("/odom", Odometry)
        cls.listener = Listener()

    def setUp(self):
        """Each test starts with a camera that works."""
        self.control.set(**HEALTHY)
        self.expect_odometry()
        self.assertTrue(
            self.listener.wait_diagnostics("camera", lambda v: v["level"] == 0, PATIENCE))

    def expect_odometry(self):
        self.assertTrue(self.odometry.wait_more(10, PATIENCE), "no odometry")

    def expect_line(self, mark, text):
        self.assertTrue(self.listener.wait_line(mark, text, PATIENCE), f"no message '{text}'")

    def break_and_mend(self, broken, mended, *texts):
        """Changes what acts when the camera is opened: it is plugged out meanwhile."""
        self.control.set(present=0)
        self.assertTrue(
            self.listener.wait_diagnostics("camera", lambda v: v["fault"] == "no device", PATIENCE))
        mark = self.listener.mark()
        self.control.set(present=1, **broken)
        for text in texts:
            self.expect_line(mark, text)
        lines = self.listener.lines_since(mark, texts[0])
        self.assertEqual(len(lines), 1, "the message is not repeated")
        self.assertIn("Retrying", lines[0])
        self.assertTrue(
            self.listener.wait_diagnostics(
                "camera", lambda v: texts[0] in v["summary"] and v["level"] == 2, PATIENCE))
        self.control.set(**mended)
        self.expect_line(mark, "is open")
        self.expect_odometry()

    def test_unplugged_and_plugged_in_again(self):
        mark = self.listener.mark()
        self.control.set(present=0)
        self.expect_line(mark, "was unplugged")
        self.expect_line(mark, "No OpenNI2 camera is connected. Plug the camera in")
        self.assertTrue(
            self.listener.wait_diagnostics(
                "camera", lambda v: v["level"] == 2 and int(v["failed attempts"]) > 2 and
                float(v["processor of the camera thread (%)"]) < MAX_PROCESSOR, PATIENCE))
        self.control.set(present=1)
        self.expect_line(mark, "is open")
        self.expect_odometry()
        self.assertTrue(
            self.listener.wait_diagnostics(
                "camera", lambda v: v["level"] == 0 and float(v["reconnections"]) > 0, PATIENCE))

    def test_taken_by_another_process(self):
        self.break_and_mend({"in_use": 1}, {"in_use": 0}, "Close the other program")

    def test_no_permission(self):
        self.break_and_mend({"no_permission": 1}, {"no_permission": 0}, "Install the udev rules")

    def test_without_color(self):
        self.break_and_mend({"color": 0}, {"color": 1}, "has no color stream",
                            "use a model with a color camera")

    def test_without_registration(self):
        self.break_and_mend({"registration": 0}, {"registration": 1},
                            "cannot register depth to color", "depth_image_proc")

    def test_half_the_rate(self):
        mark = self.listener.mark()
        self.control.set(rate=15)
        self.expect_line(mark, "images per second instead of 30")
        self.expect_line(mark, "USB bandwidth")
        self.expect_odometry()
        self.control.set(rate=30)
        self.expect_line(mark, "full rate again")
        self.expect_odometry()

    def test_depth_stops(self):
        mark = self.listener.mark()
        self.control.set(depth_stalls=1)
        self.expect_line(mark, "delivers no depth any more")
        self.control.set(depth_stalls=0)
        self.expect_odometry()

    def test_lost_images_are_counted(self):
        before = self.camera_value("color dropped")
        self.control.set(drop_every=5)
        self.assertTrue(
            self.listener.wait_diagnostics(
                "camera", lambda v: float(v["color dropped"]) > before + 5, PATIENCE))
        self.expect_odometry()
        self.control.set(drop_every=0)
        self.expect_odometry()

    def test_late_depth_is_paired(self):
        self.control.set(depth_delay=0.05)
        self.expect_odometry()
        alone = self.camera_value("images without partner")
        pairs = self.camera_value("pairs")
        self.assertTrue(
            self.listener.wait_diagnostics(
                "camera", lambda v: float(v["pairs"]) > pairs + 60, PATIENCE))
        self.assertLess(self.camera_value("images without partner"), alone + 10)
        self.control.set(depth_delay=0)

    # These three were said before this test listened to the log.

    def test_dummy_device(self):
        self.expect_fault("dummy", "does not offer 640x480", "mode not offered")

    def test_wrong_uri(self):
        self.expect_fault("wrong", "There is no device 'bogus://1'", "wrong address")

    def test_wrong_parameter(self):
        self.expect_fault("idle", "idle: parameter depth_unit is 0.002", "")

    def expect_fault(self, node, text, fault):
        self.assertTrue(
            self.listener.wait_diagnostics(
                node, lambda v: text in v["summary"] and v["level"] == 2 and
                v.get("fault", "") == fault, PATIENCE), self.listener.status(node))

    def camera_value(self, name):
        return float(self.listener.status("camera")[name])


if __name__ == "__main__":
    import rostest
    rospy.init_node("camera_faults_test")
    rostest.rosrun("mivo", "camera_faults", FaultsTest)
