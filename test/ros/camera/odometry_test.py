#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Camera and odometry in one manager give the poses of run_sequence on the same folder."""

import math
import os
import sys
import unittest

import rospy
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from virtual_camera import Control, Counter, Listener, Truth, read_trajectory

MAX_TRANSLATION = 0.002  # m
MAX_ROTATION = 0.1  # deg
MAX_TIME = 0.008  # s, between a stamp and the image it belongs to
MIN_COVERAGE = 0.95  # of the frames of a recording: playing it, a busy machine may lose one


def pose_of(message):
    p, q = message.pose.pose.position, message.pose.pose.orientation
    return (p.x, p.y, p.z, q.x, q.y, q.z, q.w)


def difference(a, b):
    """Distance in meters and angle in degrees."""
    dot = abs(sum(x * y for x, y in zip(a[3:], b[3:])))
    return math.dist(a[:3], b[:3]), math.degrees(2.0 * math.acos(min(1.0, dot)))


class OdometryTest(unittest.TestCase):
    def setUp(self):
        self.expected = [pose[1:] for pose in read_trajectory(os.environ["MIVO_TEST_TRAJECTORY"])]
        self.odometry = Counter("/odom", Odometry)
        self.listener = Listener()

    def compare(self, pairs):
        """pairs: (frame, pose)."""
        worst = [0.0, 0.0]
        for frame, pose in pairs:
            translation, rotation = difference(pose, self.expected[frame])
            worst = [max(worst[0], translation), max(worst[1], rotation)]
        return worst

    def check(self, pairs, least):
        """`least`: part of the frames that must have been tracked."""
        last = len(self.expected) - 1
        covered = {frame for frame, _ in pairs}
        worst = self.compare(pairs)
        print(f"== {len(pairs)} poses, {len(covered)} of {last + 1} frames, "
              f"worst difference {1e3 * worst[0]:.3f} mm, {worst[1]:.4f} deg")
        self.assertGreaterEqual(len(covered), least * len(self.expected))
        self.assertLess(worst[0], MAX_TRANSLATION)
        self.assertLess(worst[1], MAX_ROTATION)
        # The path is long compared to the tolerance, or the comparison would say nothing.
        length = max(difference(pose, self.expected[0])[0] for pose in self.expected)
        self.assertGreater(length, 20 * MAX_TRANSLATION)

    def test_live(self):
        if os.environ.get("MIVO_TEST_RECORDING"):
            self.skipTest("playing a recording")
        control = Control()
        truth_path = control.path + ".truth"
        control.set(truth=truth_path)
        last = len(self.expected) - 1
        self.assertTrue(self.odometry.wait_more(5, 60), "no odometry of the first image")
        truth = Truth(truth_path)
        # A busy machine may lose images: each is shown until it was tracked.
        for frame in range(1, last + 1):
            control.play(until=frame)
            while self.latest_frame(truth) < frame:
                self.assertTrue(self.odometry.wait_more(1, 30), "odometry stopped")
        truth.read()
        pairs = []
        for message in self.odometry.messages:
            stamp = message.header.stamp.to_sec()
            i = truth.nearest(stamp)
            if truth.times[0] - MAX_TIME < stamp < truth.times[-1] + MAX_TIME:
                self.assertLess(abs(truth.times[i] - stamp), MAX_TIME)
                pairs.append((truth.frames[i], pose_of(message)))
        self.check(pairs, 1.0)

    def latest_frame(self, truth):
        """Frame of the sequence that was tracked last."""
        stamp = self.odometry.messages[-1].header.stamp.to_sec()
        truth.read()
        return truth.frames[truth.nearest(stamp)]

    def test_recording(self):
        if not os.environ.get("MIVO_TEST_RECORDING"):
            self.skipTest("live")
        truth = Truth(os.environ["MIVO_TEST_RECORDING"] + ".truth").read()
        self.assertTrue(self.odometry.wait_more(5, 30), "no odometry of the recording")
        self.assertTrue(
            self.listener.wait_diagnostics("camera",
                                           lambda v: v.get("state") == "recording ended", 60),
            "the recording does not end")
        stamps = [m.header.stamp.to_sec() for m in self.odometry.messages]
        # The recording's clock starts at its first image; which image was the first to be tracked is
        # the one unknown, and found by trying.
        best = None
        for shift in range(len(truth.times) - len(stamps) + 15):
            if shift >= len(truth.times):
                break
            offset = truth.times[shift] - stamps[0]
            indices = [truth.nearest(stamp + offset) for stamp in stamps]
            pairs = [(truth.frames[i], pose_of(m))
                     for i, m in zip(indices, self.odometry.messages)]
            worst = self.compare(pairs)
            if best is None or worst[0] < best[0]:
                best = (worst[0], pairs)
        self.check(best[1], MIN_COVERAGE)


if __name__ == "__main__":
    import rostest
    rospy.init_node("camera_odometry_test")
    rostest.rosrun("mivo", "camera_odometry", OdometryTest)
