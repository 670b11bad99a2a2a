#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A recording played in real time: nearly all frames are tracked, the node adds next to nothing to the
time that the tracker takes, and the poses on odom are those of run_sequence on the same frames.

How long a frame takes from the images to the odometry is printed. It is not checked, for on a busy
machine it says more about the other work."""

import math
import os
import statistics
import subprocess
import threading
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from mivo.msg import TrackingStatus
from nav_msgs.msg import Odometry

MIN_TRACKED = 0.98  # of the frames
MAX_TRANSLATION = 0.001  # m
MAX_ROTATION = 0.05  # deg
PERIOD = 1.0 / 30.0  # s
# From the arrival of the images to the odometry, beyond the processor time of the tracker. Waiting for
# another image, say, would make every frame late; other work on the machine leaves some frames alone.
MAX_OVERHEAD = 0.001  # s
UNDISTURBED = 0.1  # of the frames, at least
MAX_MEMORY = 120.0  # MB, resident
PATIENCE = 60.0  # s
END = 5.0  # s without a frame: the recording has ended
STAMP = 2e-6  # s: stamps of trajectories have six decimals


def read_lines(path):
    """Fields of each line that is no comment."""
    with open(path, encoding="ascii") as file:
        return [line.split() for line in file if line.strip() and not line.startswith("#")]


def difference(a, b):
    """Distance in meters and angle in degrees of two (tx, ty, tz, qx, qy, qz, qw)."""
    dot = abs(sum(x * y for x, y in zip(a[3:], b[3:])))
    norm = math.sqrt(sum(x * x for x in a[3:]) * sum(x * x for x in b[3:]))
    return math.dist(a[:3], b[:3]), math.degrees(2.0 * math.acos(min(1.0, dot / norm)))


class Process:
    """What a node costs, from the system."""

    def __init__(self, node):
        uri = rosgraph.Master("/test").lookupNode(node)
        _, _, self.pid = xmlrpc.client.ServerProxy(uri).getPid("/test")
        self.wall = time.monotonic()
        self.processor = self._processor()

    def _processor(self):
        with open(f"/proc/{self.pid}/stat", encoding="ascii") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def cores(self):
        """Cores in use, mean since the start."""
        return (self._processor() - self.processor) / (time.monotonic() - self.wall)

    def memory(self):
        """Most resident memory so far, MB."""
        with open(f"/proc/{self.pid}/status", encoding="ascii") as file:
            line = next(line for line in file if line.startswith("VmHWM"))
        return int(line.split()[1]) / 1024.0


class LiveRecordingTest(unittest.TestCase):
    def setUp(self):
        self.condition = threading.Condition()
        self.odometry = []
        self.status = []
        self.diagnosed = {}
        rospy.Subscriber("/odom", Odometry, lambda m: self.add(self.odometry, m), queue_size=1000)
        rospy.Subscriber("/status", TrackingStatus, lambda m: self.add(self.status, m),
                         queue_size=1000)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.diagnose, queue_size=100)

    def add(self, messages, message):
        with self.condition:
            messages.append(message)
            self.condition.notify_all()

    def diagnose(self, array):
        with self.condition:
            for status in array.status:
                for pair in status.values:
                    self.diagnosed[pair.key] = pair.value

    def wait_for_end(self, last):
        """Until the last frame has come, or none for a while."""
        with self.condition:
            self.assertTrue(self.condition.wait_for(lambda: self.status, PATIENCE), "no frame")
            count = 0
            while count < len(self.status):
                count = len(self.status)
                if abs(self.status[-1].header.stamp.to_sec() - last) < STAMP:
                    break
                self.condition.wait_for(lambda: len(self.status) > count, END)
            # The odometry of a frame is published before its status, on another connection.
            self.condition.wait_for(lambda: len(self.odometry) == len(self.status), END)

    def expected(self, stamps):
        """Poses of run_sequence on these frames alone."""
        source = os.environ["MIVO_TEST_SEQUENCE"]
        folder = os.path.join(os.environ["MIVO_TEST_FOLDER"], "tracked")
        os.mkdir(folder)
        for name in ("rgb", "depth", "camera.txt", "rgb.txt", "depth.txt"):
            os.symlink(os.path.join(os.path.abspath(source), name), os.path.join(folder, name))
        frames = [line for line in read_lines(os.path.join(source, "associations.txt"))
                  if any(abs(float(line[0]) - stamp) < STAMP for stamp in stamps)]
        self.assertEqual(len(frames), len(stamps))
        with open(os.path.join(folder, "associations.txt"), "w", encoding="ascii") as file:
            file.writelines(" ".join(line) + "\n" for line in frames)
        path = os.path.join(folder, "trajectory.txt")
        subprocess.run([os.path.join(os.environ["MIVO_TEST_PROGRAMS"], "run_sequence"), folder,
                        "--output", path], check=True, stdout=subprocess.DEVNULL)
        return [tuple(map(float, line)) for line in read_lines(path)]

    def test_recording(self):
        frames = read_lines(os.path.join(os.environ["MIVO_TEST_SEQUENCE"], "associations.txt"))
        with self.condition:
            self.assertTrue(self.condition.wait_for(lambda: self.status, PATIENCE), "no frame")
        process = Process("/manager")
        self.wait_for_end(float(frames[-1][0]))
        cores, memory = process.cores(), process.memory()

        tracked = [m for m in self.status
                   if m.state in (TrackingStatus.TRACKING, TrackingStatus.DEGRADED)]
        processor = statistics.median(m.total_cpu_ms for m in self.status)
        overhead = sorted(m.processing_latency - 1e-3 * m.total_cpu_ms for m in self.status)
        undisturbed = overhead[int(UNDISTURBED * len(overhead))]
        dropped = self.status[-1].dropped_frames
        latency = sorted(m.processing_latency for m in self.status)
        median, late = statistics.median(latency), latency[int(0.95 * (len(latency) - 1))]
        print(f"== {len(tracked)} of {len(frames)} frames tracked, "
              f"{dropped} dropped, {self.status[-1].skipped_frames} skipped")
        print(f"== latency from the images to the odometry: median {1e3 * median:.2f} ms, "
              f"95 % {1e3 * late:.2f} ms, most {1e3 * latency[-1]:.2f} ms; in the last seconds, as "
              f"diagnosed: {self.diagnosed.get('from images to odometry (ms, median)')} ms")
        print(f"== of it in the tracker: median {processor:.2f} ms of processor time; beyond it: median "
              f"{1e3 * statistics.median(overhead):.2f} ms, undisturbed {1e3 * undisturbed:.2f} ms")
        print(f"== nodelet manager: {memory:.1f} MB resident, {100.0 * cores:.0f} % of a core")

        stamps = [m.header.stamp.to_sec() for m in self.status]
        poses = self.expected(stamps)
        worst = [0.0, 0.0]
        published = 0
        for message in self.odometry:
            stamp = message.header.stamp.to_sec()
            pose = next(pose for pose in poses if abs(pose[0] - stamp) < STAMP)
            p, q = message.pose.pose.position, message.pose.pose.orientation
            translation, rotation = difference((p.x, p.y, p.z, q.x, q.y, q.z, q.w), pose[1:])
            worst = [max(worst[0], translation), max(worst[1], rotation)]
            published += 1
        print(f"== {published} poses on odom, worst difference to run_sequence on the same frames "
              f"{1e3 * worst[0]:.6f} mm, {worst[1]:.6f} deg")
        self.assertEqual(published, len(tracked))
        # Frames are dropped, and counted, where other work leaves the node too little time.
        self.assertGreaterEqual(len(tracked) + dropped, MIN_TRACKED * len(frames))
        self.assertLess(1e-3 * processor, 0.5 * PERIOD)
        self.assertLess(worst[0], MAX_TRANSLATION)
        self.assertLess(worst[1], MAX_ROTATION)
        self.assertLess(undisturbed, MAX_OVERHEAD)
        self.assertLess(memory, MAX_MEMORY)


if __name__ == "__main__":
    import rostest
    rospy.init_node("live_recording_test")
    rostest.rosrun("mivo", "live_recording", LiveRecordingTest)
