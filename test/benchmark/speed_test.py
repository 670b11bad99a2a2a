# SPDX-License-Identifier: BSD-3-Clause
"""Tests by value of what scripts/benchmark speed computes."""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..",
                                "benchmark", "speed"))

import measure  # noqa: E402  found by the path above
import programs  # noqa: E402
import tables  # noqa: E402


def frame(milliseconds, keyframe_milliseconds=0.0):
    row = {"cpu_ms": milliseconds, "ms_pyramid": 0.1, "ms_tracking": 1.0,
           "ms_keyframe": keyframe_milliseconds, "new_keyframe": float(keyframe_milliseconds > 0),
           "state": "tracking"}
    for level in measure.LEVELS:
        row["ms_%d" % level] = 0.1 * (level + 1)
        row["ms_line_search_%d" % level] = 0.01
    return row


def measured(**milliseconds):
    rows = {name: [frame(milliseconds[name])] * 3 for name in ("ssd", "mi", "hybrid", "default")}
    return {"rows": rows, "peers": {"rgbd": 40.0, "icp": 50.0, "rgbd_icp": 90.0}}


class SpeedTest(unittest.TestCase):
    def test_quantiles_lie_between_neighbours(self):
        self.assertEqual(measure.quantile([3.0, 1.0, 2.0], 0.5), 2.0)
        self.assertEqual(measure.quantile([1.0, 2.0, 3.0, 5.0], 0.5), 2.5)
        self.assertEqual(measure.quantile([1.0, 2.0, 3.0, 5.0], 1.0), 5.0)
        self.assertAlmostEqual(measure.quantile([0.0, 10.0], 0.95), 9.5)

    def test_a_frame_is_the_median_of_its_runs(self):
        runs = [[frame(1.0), frame(9.0)], [frame(3.0), frame(7.0)], [frame(2.0), frame(8.0)]]
        self.assertEqual([row["cpu_ms"] for row in measure.by_frame(runs)], [2.0, 8.0])
        self.assertEqual(measure.by_frame(runs)[0]["state"], "tracking")

    def test_goals_are_ratios_of_medians(self):
        text = tables.goal_table({"a": measured(ssd=1.0, mi=3.0, hybrid=1.5, default=2.0)})
        values = [line.split("|")[3].strip() for line in text.splitlines()[2:]]
        self.assertEqual(values, ["20.00", "45.00", "26.67", "2.00", "1.50", "1.00"])

    def test_levels_add_up(self):
        text = tables.level_table(measured(ssd=1.0, mi=3.0, hybrid=1.5, default=2.0))
        last = [cell.strip() for cell in text.splitlines()[-1].split("|")]
        self.assertEqual(last[2], "1.500 ± 0.000")
        self.assertTrue(text.splitlines()[2].startswith("| 4 | 0.500 ± 0.000 |"))

    def test_values_and_rows_are_read(self):
        self.assertEqual(programs.read_values("frames: 3\nnoise\ncpu_ms_median: 1.5\n"),
                         {"frames": "3", "cpu_ms_median": "1.5"})
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write("stamp,state\n1.5,lost\n")
            self.assertEqual(programs.read_rows(path), [{"stamp": 1.5, "state": "lost"}])

    def test_a_missing_program_says_how_to_build_it(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(programs.ProgramError, "MIVO_WITH_BENCHMARKS"):
                programs.Programs(folder, folder).run("run_sequence")


if __name__ == "__main__":
    unittest.main()
