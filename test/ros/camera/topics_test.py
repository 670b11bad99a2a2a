#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Topics, frames, calibration, live settings and lazy streams of the stand-alone camera node."""

import os
import sys
import time
import unittest

import dynamic_reconfigure.client
import numpy
import rospy
import tf2_ros
from sensor_msgs.msg import CameraInfo, Image

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from virtual_camera import Control, Counter, Listener

PATIENCE = 20  # s


def wait_until(condition, timeout):
    """True once what no message announces has come about."""
    end = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > end:
            return False
        rospy.rostime.wallsleep(0.1)
    return True


class TopicsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.control = Control()
        cls.control.set(present=1)
        cls.listener = Listener()

    def wait(self, topic, kind):
        return rospy.wait_for_message(topic, kind, timeout=PATIENCE)

    def test_images(self):
        color = self.wait("/camera/rgb/image_raw", Image)
        self.assertEqual((color.encoding, color.width, color.height, color.step),
                         ("rgb8", 640, 480, 1920))
        self.assertEqual(color.header.frame_id, "camera_rgb_optical_frame")
        depth = self.wait("/camera/depth_registered/image_raw", Image)
        self.assertEqual((depth.encoding, depth.width, depth.height, depth.step),
                         ("16UC1", 640, 480, 1280))
        self.assertEqual(depth.header.frame_id, "camera_rgb_optical_frame")
        self.assertGreater(numpy.frombuffer(depth.data, numpy.uint16).max(), 300)

    def test_pairs_have_one_stamp(self):
        color = Counter("/camera/rgb/camera_info", CameraInfo)
        depth = Counter("/camera/depth_registered/camera_info", CameraInfo)
        self.addCleanup(color.stop)
        self.addCleanup(depth.stop)
        # Images are lost on a busy machine, but a stamp that differs would differ in all pairs.
        self.assertTrue(
            wait_until(lambda: len(color.stamps() & depth.stamps()) > 40, PATIENCE),
            f"{len(color.stamps() & depth.stamps())} pairs")

    def test_calibration_from_field_of_view(self):
        # The virtual camera tells the field of view of the sequence's camera.
        with open(os.environ["MIVO_TEST_SEQUENCE"] + "/camera.txt", encoding="ascii") as file:
            fx = float([line for line in file if not line.startswith("#")][0].split()[2])
        info = self.wait("/camera/rgb/camera_info", CameraInfo)
        self.assertAlmostEqual(info.K[0], fx, delta=1e-3)
        self.assertEqual(info.K[0], info.K[4])
        self.assertEqual((info.K[2], info.K[5]), (319.5, 239.5))
        self.assertEqual((info.width, info.height, info.distortion_model), (640, 480, "plumb_bob"))
        self.assertEqual(self.wait("/camera/depth_registered/camera_info", CameraInfo).K, info.K)

    def test_frames(self):
        buffer = tf2_ros.Buffer()
        tf2_ros.TransformListener(buffer)
        for frame, y in (("camera_rgb_optical_frame", -0.045), ("camera_depth_optical_frame", -0.02)):
            transform = buffer.lookup_transform("camera_link", frame, rospy.Time(0),
                                                rospy.Duration(PATIENCE)).transform
            self.assertAlmostEqual(transform.translation.y, y)
            q = transform.rotation
            # Optical z is forward, x of the link.
            self.assertAlmostEqual(2 * (q.x * q.z + q.w * q.y), 1.0)

    def test_live_settings_are_read_back(self):
        subscriber = rospy.Subscriber("/camera/rgb/camera_info", CameraInfo, lambda _: None)
        self.addCleanup(subscriber.unregister)
        client = dynamic_reconfigure.client.Client("/camera", timeout=PATIENCE)
        self.wait("/camera/rgb/camera_info", CameraInfo)
        client.update_configuration({"auto_exposure": False, "exposure": 21, "gain": 55})
        self.assertTrue(
            self.listener.wait_diagnostics(
                "camera", lambda v: "auto exposure off" in v.get("settings", "") and
                "exposure 21, gain 55" in v["settings"], PATIENCE))
        # A camera that no longer obeys: what it has is published, not what was asked for.
        self.control.set(deaf=1, present=0)
        self.assertTrue(self.listener.wait_line(0, "was unplugged", PATIENCE))
        self.control.set(present=1)
        self.assertTrue(self.listener.wait_line(0, "auto exposure stays on instead of off", PATIENCE))
        self.assertTrue(
            wait_until(lambda: client.get_configuration()["auto_exposure"], PATIENCE))
        self.control.set(deaf=0)

    def test_streams_only_while_somebody_listens(self):
        self.assertTrue(
            self.listener.wait_diagnostics("camera", lambda v: v.get("state") == "idle", PATIENCE))
        subscriber = rospy.Subscriber("/camera/depth_registered/image_raw", Image, lambda _: None)
        self.assertTrue(
            self.listener.wait_diagnostics("camera", lambda v: v.get("state") == "streaming",
                                           PATIENCE))
        subscriber.unregister()
        self.assertTrue(
            self.listener.wait_diagnostics("camera", lambda v: v.get("state") == "idle", PATIENCE))


if __name__ == "__main__":
    import rostest
    rospy.init_node("camera_topics_test")
    rostest.rosrun("mivo", "camera_topics", TopicsTest)
