# SPDX-License-Identifier: BSD-3-Clause
"""Tests by value of the tables of scripts/benchmark speed."""

import os
import sys
import unittest

BENCHMARK = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "benchmark")
sys.path[:0] = [os.path.join(BENCHMARK, "speed"), BENCHMARK]

import tables  # noqa: E402  found by the path above
from measuring.tables import LEVELS, level_table  # noqa: E402


def frame(milliseconds, keyframe_milliseconds=0.0):
    row = {"cpu_ms": milliseconds, "ms_pyramid": 0.1, "ms_tracking": 1.0,
           "ms_keyframe": keyframe_milliseconds, "new_keyframe": float(keyframe_milliseconds > 0),
           "state": "tracking"}
    for level in LEVELS:
        row["ms_%d" % level] = 0.1 * (level + 1)
        row["ms_line_search_%d" % level] = 0.01
    return row


def measured(**milliseconds):
    rows = {name: [frame(milliseconds[name])] * 3 for name in ("ssd", "mi", "hybrid", "default")}
    return {"rows": rows, "peers": {"rgbd": 40.0, "icp": 50.0, "rgbd_icp": 90.0}}


class SpeedTest(unittest.TestCase):
    def test_goals_are_ratios_of_medians(self):
        text = tables.goal_table({"a": measured(ssd=1.0, mi=3.0, hybrid=1.5, default=2.0)})
        values = [line.split("|")[3].strip() for line in text.splitlines()[2:]]
        self.assertEqual(values, ["20.00", "45.00", "26.67", "2.00", "1.50", "1.00"])

    def test_levels_add_up(self):
        text = level_table(measured(ssd=1.0, mi=3.0, hybrid=1.5, default=2.0)["rows"])
        last = [cell.strip() for cell in text.splitlines()[-1].split("|")]
        self.assertEqual(last[2], "1.500 ± 0.000")
        self.assertTrue(text.splitlines()[2].startswith("| 4 | 0.500 ± 0.000 |"))


if __name__ == "__main__":
    unittest.main()
