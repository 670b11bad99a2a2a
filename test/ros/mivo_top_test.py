#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What mivo_top shows of status messages.   mivo_top_test.py MIVO_TOP"""

import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

import rosbag
import rospy
from mivo.msg import TrackingStatus

PROGRAM = os.path.abspath(sys.argv.pop(1))
LOADER = importlib.machinery.SourceFileLoader("mivo_top", PROGRAM)
mivo_top = importlib.util.module_from_spec(importlib.util.spec_from_loader("mivo_top", LOADER))
LOADER.exec_module(mivo_top)

NOTHING_IN_COMMON = "image has nothing in common with the keyframe"


def message(state, reason="", **values):
    status = TrackingStatus(state=getattr(TrackingStatus, state.upper()), state_text=state, reason_text=reason,
                            total_cpu_ms=2.0, overlap=0.5, keyframe=3, keyframes=4)
    status.reason = TrackingStatus.REASON_NOTHING_IN_COMMON if reason else TrackingStatus.REASON_NONE
    for name, value in values.items():
        setattr(status, name, value)
    return status


def history_of(*states):
    """Of 10 Hz."""
    history = mivo_top.History()
    for i, state in enumerate(states):
        history.add(message(state, NOTHING_IN_COMMON if state == "lost" else ""), 0.1 * i)
    return history


def run(*options):
    return subprocess.run([PROGRAM, *options], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          check=False, timeout=60)


class ScreenTest(unittest.TestCase):
    def test_state_and_rate(self):
        text = "\n".join(mivo_top.screen(history_of(*["tracking"] * 21), "/status", 2.0))
        self.assertIn("/status   10.0 Hz", text)
        self.assertIn("state       tracking   for 2 s", text)
        self.assertIn("##########.......... 50 % of the keyframe in view", text)
        self.assertIn("keyframe    3 of 4, segment 0", text)
        self.assertNotIn("SILENT", text)

    def test_lost_and_why(self):
        history = history_of(*["tracking"] * 5, *["lost"] * 3)
        text = "\n".join(mivo_top.screen(history, "/status", 0.7))
        self.assertIn("lost: " + NOTHING_IN_COMMON, text)
        self.assertIn("tracking 5, lost 3; lost 0 s ago", text)
        self.assertIn("     3  " + NOTHING_IN_COMMON, text)

    def test_silence_is_told(self):
        text = "\n".join(mivo_top.screen(history_of("tracking", "tracking"), "/status", 9.1))
        self.assertIn("SILENT for 9 s", text)
        self.assertIn("no message yet", mivo_top.screen(mivo_top.History(), "/status", 0.0)[0])

    def test_the_window_forgets_but_counts_do_not(self):
        history = history_of(*["tracking"] * 300)
        self.assertLessEqual(len(history.recent), 102)
        self.assertEqual(history.states["tracking"], 300)

    def test_times_are_quantiles(self):
        history = mivo_top.History()
        for i in range(100):
            history.add(message("tracking", total_cpu_ms=float(i)), 0.01 * i)
        self.assertIn("50.0 ms per frame, 95 % below 95.0 ms", "\n".join(mivo_top.screen(history, "/s", 1.0)))

    def test_one_line(self):
        history = history_of("tracking", "lost")
        self.assertEqual(mivo_top.line(history, 0.1), f"lost: {NOTHING_IN_COMMON} | 10.0 Hz | overlap 50 % | "
                         "2.0 ms | keyframe 3 | lost 1 of 2")


class ProgramTest(unittest.TestCase):
    def test_a_recording(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "status.bag")
            with rosbag.Bag(path, "w") as bag:
                for i, state in enumerate(["tracking"] * 10 + ["lost"] * 2 + ["tracking"] * 3):
                    bag.write("/status", message(state, NOTHING_IN_COMMON if state == "lost" else ""),
                              rospy.Time(100 + i))
            result = run("--bag", path)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual([line.strip() for line in result.stdout.splitlines()[:3]],
                             ["0.00 s  tracking", f"10.00 s  lost: {NOTHING_IN_COMMON}", "12.00 s  tracking"])
            self.assertIn("tracking 13, lost 2", result.stdout)
            wrong = run("--bag", path, "--topic", "/other")
            self.assertEqual(wrong.returncode, 1)
            self.assertIn("no messages on /other", wrong.stderr)

    def test_without_file_or_master_it_says_so(self):
        result = run("--bag", "/nowhere.bag")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
        os.environ["ROS_MASTER_URI"] = "http://localhost:1"
        result = run()
        self.assertEqual(result.returncode, 1)
        self.assertIn("no ROS master at http://localhost:1", result.stderr)


if __name__ == "__main__":
    unittest.main()
