# SPDX-License-Identifier: BSD-3-Clause
"""Tests of what scripts/reproduce_paper does around the programs."""

import os
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "..",
                                "benchmark", "paper"))

import findings
import plan as plans
import report
import results
from experiments import Experiments
from jobs import Folder, Job, JobError, run_jobs

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

    def test_another_program_makes_it_run_again(self):
        program = self.folder.file("program")
        for text in ("#!/bin/sh\necho 1 >> log\n", "#!/bin/sh\necho 2 >> log\n"):
            with open(program, "w", encoding="utf-8") as script:
                script.write(text)
            os.chmod(program, 0o755)
            run_jobs([Job("one", [[program]])], self.again(), 1)
        self.assertEqual(self.read("log"), "1\n2\n")

    def test_a_failure_is_told_and_not_taken_for_done(self):
        bad = Job("bad", [shell("echo why >&2; exit 3")])
        with self.assertRaisesRegex(JobError, r"bad: sh failed \(code 3\): why"):
            run_jobs([bad], self.folder, 2)
        self.assertFalse(self.folder.is_done(bad))

    def test_a_signal_is_told_too(self):
        with self.assertRaisesRegex(JobError, r"bad: sh failed \(signal 9\)"):
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
        with self.assertRaises(JobError):
            run_jobs([good, bad, never], self.folder, 2)
        self.assertTrue(self.folder.is_done(good))
        self.assertFalse(os.path.exists(self.folder.file("never")))

    def test_what_measures_time_runs_after_the_rest(self):
        alone = Job("alone", [shell("echo alone >> log")], alone=True)
        run_jobs([alone, Job("one", [shell("echo one >> log")])], self.folder, 2)
        self.assertEqual(self.read("log"), "one\nalone\n")


class NumberTest(unittest.TestCase):
    def test_wilson_interval_by_its_definition(self):
        # The bounds are the rates p for which the observed one is 1.96 deviations away.
        for successes, trials in ((0, 50), (7, 10), (999, 1000)):
            observed = successes / trials
            for p in results.wilson(successes, trials):
                if 0 < p < 1 and p != observed:
                    self.assertAlmostEqual(
                        abs(observed - p) / np.sqrt(p * (1 - p) / trials), 1.96, places=6)
        self.assertEqual(results.wilson(0, 50)[0], 0.0)

    def test_three_digits(self):
        self.assertEqual([report.number(v) for v in (0.123, 1.234, 12.34, 123.4)],
                         ["0.12", "1.23", "12.3", "123"])
        with self.assertRaises(JobError):
            report.number(float("nan"))

    def test_basin(self):
        row = lambda magnitude, successes: {"magnitude": magnitude, "trials": 100.0,
                                            "successes": successes, "milliseconds_mean": 1.0}
        basin = results.Basin([row(0.1, 90.0), row(0.2, 50.0)])
        self.assertAlmostEqual(basin.mean(), 0.7)
        self.assertAlmostEqual(basin.variance(), (0.09 + 0.25) / 100 / 4)


class FindingTest(unittest.TestCase):
    def basins(self, rates):
        row = lambda rate: [{"magnitude": 0.1, "trials": 1000.0, "successes": 1000.0 * rate,
                             "milliseconds_mean": 1.0}]

        class Fixed:
            @staticmethod
            def basin(method):
                return results.Basin(row(rates[method.key]))
        return Fixed()

    def verdict(self, mi, ssd):
        found = findings.basin_finding(self.basins({"mi_8": mi, "ssd": ssd}), "", findings.MI_8,
                                       findings.SSD)
        return found.verdict

    def test_a_difference_counts_beyond_its_interval_only(self):
        self.assertEqual(self.verdict(0.5, 0.6), findings.HOLDS)
        self.assertEqual(self.verdict(0.6, 0.5), findings.FAILS)
        self.assertEqual(self.verdict(0.5, 0.51), findings.UNDECIDED)


class PlanTest(unittest.TestCase):
    def test_jobs_have_names_of_their_own_and_run_after_their_sequences(self):
        for quick in (True, False):
            experiments = Experiments(plans.Plan(quick), "/nowhere", {"recording_x": "/recordings/x"})
            names = [job.name for job in experiments.jobs]
            self.assertEqual(len(names), len(set(names)))
            films = {job.name: job for job in experiments.jobs if job.name.startswith("film/")}
            for job in experiments.jobs:
                for word in [word for command in job.commands for word in command]:
                    if word.startswith("sequences/") and not job.name.startswith("film/"):
                        self.assertIn(films["film/" + word.split("/")[1]], job.after, job.name)

    def test_all_photometric_models_of_the_core_are_tried(self):
        tried = {method.settings.get("photometric_model") for method in plans.variants()}
        self.assertLessEqual({"none", "lcn"}, tried)


if __name__ == "__main__":
    unittest.main()
