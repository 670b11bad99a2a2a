#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Over a minute of a camera whose clock is 200 ppm off, published stamps grow and are the times at
which the images were taken."""

import os
import sys
import unittest

import rospy
from sensor_msgs.msg import CameraInfo

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from virtual_camera import Control, Counter, Truth

SECONDS = 60
MAX_ERROR = 0.002  # s


class StampsTest(unittest.TestCase):
    def test_minute(self):
        control = Control()
        truth_path = control.path + ".truth"
        control.set(truth=truth_path, clock_ppm=200, jitter=0.003)
        color = Counter("/camera/rgb/camera_info", CameraInfo)
        depth = Counter("/camera/depth_registered/camera_info", CameraInfo)
        self.assertTrue(color.wait_more(SECONDS * 30 * 9 // 10, SECONDS + 60), "images stopped")
        truth = Truth(truth_path).read()
        for name, counter in (("color", color), ("depth", depth)):
            stamps = [m.header.stamp.to_sec() for m in counter.messages]
            self.assertGreater(len(stamps), SECONDS * 25)
            self.assertTrue(all(a < b for a, b in zip(stamps, stamps[1:])), name)
            worst = max(abs(truth.times[truth.nearest(s)] - s) for s in stamps
                        if s <= truth.times[-1])
            print(f"== {name}: {len(stamps)} stamps, worst error {1e3 * worst:.3f} ms")
            self.assertLess(worst, MAX_ERROR, name)


if __name__ == "__main__":
    import rostest
    rospy.init_node("camera_stamps_test")
    rostest.rosrun("mivo", "camera_stamps", StampsTest)
