# SPDX-License-Identifier: BSD-3-Clause
"""Tests of what scripts/reproduce_paper does around the programs."""

import os
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "..",
                                "benchmark", "paper"))

import findings
import plan as plans
import report
import results
from experiments import Experiments
from measuring.programs import MeasuringError

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
        with self.assertRaises(MeasuringError):
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


class AllPrograms:
    """A build in which nothing is missing."""

    @staticmethod
    def path(name):
        return "/nowhere/" + name

    @staticmethod
    def has(_):
        return True


class PlanTest(unittest.TestCase):
    def test_jobs_have_names_of_their_own_and_run_after_their_sequences(self):
        for quick in (True, False):
            experiments = Experiments(plans.Plan(quick), AllPrograms, {"recording_x": "/recordings/x"})
            names = [job.name for job in experiments.jobs]
            self.assertEqual(len(names), len(set(names)))
            films = {job.name: job for job in experiments.jobs if job.name.startswith("film/")}
            for job in experiments.jobs:
                for word in [word for command in job.commands for word in command]:
                    if word.startswith("sequences/") and not job.name.startswith("film/"):
                        self.assertIn(films["film/" + word.split("/")[1]], job.after, job.name)
                    if word == "/recordings/x":
                        self.assertEqual(job.sequences, [word], job.name)

    def test_all_photometric_models_of_the_core_are_tried(self):
        tried = {method.settings.get("photometric_model") for method in plans.variants()}
        self.assertLessEqual({"none", "lcn"}, tried)


if __name__ == "__main__":
    unittest.main()
