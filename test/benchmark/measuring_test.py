# SPDX-License-Identifier: BSD-3-Clause
"""Tests of what the benchmarks have in common."""

import os
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..",
                                "benchmark"))

from measuring import sequences, statistics, trajectories  # noqa: E402  found by the path above
from measuring.jobs import Folder, Job, run_jobs  # noqa: E402
from measuring.keys import sequence_key  # noqa: E402
from measuring.programs import MeasuringError, Programs  # noqa: E402

SH = "/bin/sh"


def shell(script, *target):
    return [SH, "-c", script] + list(target)


class JobTest(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Folder(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def read(self, name):
        with open(self.folder.file(name), encoding="utf-8") as text:
            return text.read()

    def again(self):
        """The same folder as another process would find it."""
        return Folder(self.temporary.name)

    def test_runs_in_the_order_of_dependence(self):
        first = Job("first", [shell("echo first >> log")])
        second = Job("second", [shell("echo second >> log")], after=[first])
        third = Job("third", [shell("echo third >> log")], after=[second])
        run_jobs([third, second, first], self.folder, 2)
        self.assertEqual(self.read("log"), "first\nsecond\nthird\n")

    def test_writes_standard_output_to_the_target(self):
        run_jobs([Job("one", [shell("echo text", ">", "sub/file")])], self.folder, 1)
        self.assertEqual(self.read("sub/file"), "text\n")

    def test_what_is_done_is_not_done_again(self):
        for _ in range(2):
            run_jobs([Job("one", [shell("echo once >> log")])], self.again(), 1)
        self.assertEqual(self.read("log"), "once\n")

    def test_other_words_or_other_input_make_it_run_again(self):
        for word in ("a", "b"):
            first = Job("first", [shell("echo %s > input" % word)])
            run_jobs([first, Job("second", [shell("cat input >> log")], after=[first])],
                     self.again(), 2)
        self.assertEqual(self.read("log"), "a\nb\n")

    def write_program(self, text, folder=""):
        path = self.folder.file(folder, "program")
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as script:
            script.write("#!/bin/sh\n" + text + "\n")
        os.chmod(path, 0o755)
        return path

    def test_another_program_makes_it_run_again(self):
        for text in ("echo 1 >> log", "echo 2 >> log"):
            run_jobs([Job("one", [[self.write_program(text)]])], self.again(), 1)
        self.assertEqual(self.read("log"), "1\n2\n")

    def test_the_same_program_of_another_time_and_place_does_not(self):
        for folder, seconds in (("a", 1e9), ("b", 2e9)):
            program = self.write_program("echo once >> log", folder)
            os.utime(program, (seconds, seconds))
            run_jobs([Job("one", [[program]])], self.again(), 1)
        self.assertEqual(self.read("log"), "once\n")

    def test_another_recording_of_the_same_name_makes_it_run_again(self):
        recording = self.folder.file("recording")
        os.makedirs(recording)
        for pose in ("0 0 0", "0 0 0", "1 0 0"):
            with open(os.path.join(recording, "groundtruth.txt"), "w", encoding="utf-8") as truth:
                truth.write(pose)
            run_jobs([Job("one", [shell("echo again >> log")], sequences=[recording])],
                     self.again(), 1)
        self.assertEqual(self.read("log"), "again\nagain\n")

    def test_what_was_interrupted_is_not_done(self):
        run_jobs([Job("one", [shell("true")])], self.folder, 1)
        with self.assertRaises(MeasuringError):
            self.again().run(Job("one", [shell("exit 1")]))
        self.assertFalse(self.again().is_done(Job("one", [shell("true")])))

    def test_a_failure_is_told_and_not_taken_for_done(self):
        bad = Job("bad", [shell("echo why >&2; exit 3")])
        with self.assertRaisesRegex(MeasuringError, r"bad: sh failed \(code 3\): why"):
            run_jobs([bad], self.folder, 2)
        self.assertFalse(self.folder.is_done(bad))

    def test_an_exit_code_may_be_a_result(self):
        run_jobs([Job("one", [shell("echo none; exit 1", ">", "file")], accepted=(0, 1))],
                 self.folder, 1)
        self.assertEqual(self.read("file"), "none\n")

    def test_a_signal_is_told_too(self):
        with self.assertRaisesRegex(MeasuringError, r"bad: sh failed \(signal 9\)"):
            run_jobs([Job("bad", [shell("kill -9 $$")])], self.folder, 1)

    def test_processor_time_is_that_of_the_programs(self):
        spin = Job("spin", [["/usr/bin/env", "python3", "-c",
                             "import time\nwhile time.process_time() < 0.2: pass"]])
        rest = Job("rest", [shell("true")])
        run_jobs([spin, rest], self.folder, 2)
        minutes = self.folder.processor_minutes([spin, rest])
        self.assertGreaterEqual(60 * minutes, 0.19)
        self.assertLess(60 * minutes, 2.0)

    def test_after_a_failure_the_rest_is_kept(self):
        good = Job("good", [shell("true")])
        bad = Job("bad", [shell("exit 1")], after=[good])
        never = Job("never", [shell("echo > never")], after=[bad])
        with self.assertRaises(MeasuringError):
            run_jobs([good, bad, never], self.folder, 2)
        self.assertTrue(self.folder.is_done(good))
        self.assertFalse(os.path.exists(self.folder.file("never")))

    def test_what_measures_time_runs_after_the_rest(self):
        alone = Job("alone", [shell("echo alone >> log")], alone=True)
        run_jobs([alone, Job("one", [shell("echo one >> log")])], self.folder, 2)
        self.assertEqual(self.read("log"), "one\nalone\n")


class SequenceTest(unittest.TestCase):
    def make(self, folder, recipe):
        """Whether it was made anew."""
        made = []

        def film():
            os.makedirs(folder)
            made.append(folder)
        sequences.make_once(folder, recipe, film)
        return bool(made)

    def test_a_sequence_is_made_anew_when_its_recipe_changes(self):
        with tempfile.TemporaryDirectory() as root:
            folder = os.path.join(root, "room")
            self.assertTrue(self.make(folder, ["--seed", 1]))
            first = sequence_key(folder)
            self.assertFalse(self.make(folder, ["--seed", 1]))
            self.assertTrue(self.make(folder, ["--seed", 2]))
            self.assertNotEqual(sequence_key(folder), first)

    def test_one_that_could_not_be_finished_is_not_taken(self):
        with tempfile.TemporaryDirectory() as root:
            folder = os.path.join(root, "room")
            os.makedirs(folder)
            self.assertTrue(self.make(folder, []))


class StatisticsTest(unittest.TestCase):
    def test_quantiles_lie_between_neighbors(self):
        self.assertEqual(statistics.quantile([3.0, 1.0, 2.0], 0.5), 2.0)
        self.assertEqual(statistics.quantile([1.0, 2.0, 3.0, 5.0], 0.5), 2.5)
        self.assertEqual(statistics.quantile([1.0, 2.0, 3.0, 5.0], 1.0), 5.0)
        self.assertAlmostEqual(statistics.quantile([0.0, 10.0], 0.95), 9.5)

    def test_a_frame_is_the_median_of_its_runs(self):
        frame = lambda milliseconds: {"cpu_ms": milliseconds, "state": "tracking"}
        runs = [[frame(1.0), frame(9.0)], [frame(3.0), frame(7.0)], [frame(2.0), frame(8.0)]]
        self.assertEqual([row["cpu_ms"] for row in statistics.by_frame(runs)], [2.0, 8.0])
        self.assertEqual(statistics.by_frame(runs)[0]["state"], "tracking")

    def test_values_and_rows_are_read(self):
        self.assertEqual(statistics.read_values("frames: 3\nnoise\ncpu_ms_median: 1.5\n"),
                         {"frames": "3", "cpu_ms_median": "1.5"})
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write("stamp,state\n1.5,lost\n")
            self.assertEqual(statistics.read_rows(path), [{"stamp": 1.5, "state": "lost"}])


class TrajectoryTest(unittest.TestCase):
    def test_an_error_is_that_of_the_motion(self):
        half = np.sqrt(0.5)
        a = trajectories.matrix(np.zeros(3), np.array([0.0, 0.0, half, half]))
        b = trajectories.matrix(np.array([0.0, 0.5, 0.0]), np.array([0.0, 0.0, 1.0, 0.0]))
        meters, radians = trajectories.difference(a, b, np.eye(4), np.eye(4))
        self.assertAlmostEqual(meters, 0.5)
        self.assertAlmostEqual(radians, np.pi / 2)


class ProgramsTest(unittest.TestCase):
    def test_a_missing_program_says_how_to_build_it(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(MeasuringError, "MIVO_WITH_BENCHMARKS"):
                Programs(folder).run("run_sequence")


if __name__ == "__main__":
    unittest.main()
