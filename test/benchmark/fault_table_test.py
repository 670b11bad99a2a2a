# SPDX-License-Identifier: BSD-3-Clause
"""Tests by value of the table of scripts/benchmark reliability."""

import os
import stat
import sys
import tempfile
import unittest

BENCHMARK = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "benchmark")
sys.path[:0] = [os.path.join(BENCHMARK, "reliability"), BENCHMARK]

import reliability  # noqa: E402  found by the path above
from measuring.programs import MeasuringError, Programs  # noqa: E402


class FaultTableTest(unittest.TestCase):
    def row(self, script):
        """Of a program that is this shell script."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "bin", "fault_experiment")
            os.mkdir(os.path.dirname(path))
            with open(path, "w", encoding="utf-8") as file:
                file.write("#!/bin/sh\n" + script)
            os.chmod(path, stat.S_IRWXU)
            return reliability.measure(Programs(folder), "sequence", "a fault", 7)

    def test_rows_tell_crashes_hangs_and_numbers(self):
        figures = "echo 'runs: 7'; echo 'longest_s: %s'; echo 'wrong: 2'; " \
                  "echo 'overconfident: 3'; echo 'recovery: 4'"
        self.assertEqual(["a fault", "no", "no", "2", "3", "4"], self.row(figures % "0.9"))
        self.assertEqual(["a fault", "no", "1.5 s", "2", "3", "4"], self.row(figures % "1.5"))
        self.assertEqual(["a fault", "signal 6", "", "", "", ""], self.row("kill -ABRT $$"))
        with self.assertRaisesRegex(MeasuringError, "no such folder"):
            self.row("echo no such folder >&2; exit 1")

    def test_only_its_section_is_replaced(self):
        section = "## Faults\nnew\n"
        self.assertEqual("# T\n\n## Faults\nnew\n", reliability.with_section("# T\n", section))
        self.assertEqual("# T\n\n## Faults\nnew\n\n## Next\nx\n", reliability.with_section(
            "# T\n\n## Faults\nold\n\n## Next\nx\n", section))


if __name__ == "__main__":
    unittest.main()
