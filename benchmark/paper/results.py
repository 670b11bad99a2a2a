# SPDX-License-Identifier: BSD-3-Clause
"""Reads what the jobs left behind."""

import json
import math

import numpy as np

import plan as plans  # finds the modules of measuring
from measuring.methods import TIMED
from measuring.statistics import by_frame, read_rows, read_value_file
from measuring.tables import level_sums


def wilson(successes, trials, z=1.96):
    """95 % interval of a success rate (E. B. Wilson, 1927)."""
    rate = successes / trials
    middle = (rate + z * z / (2 * trials)) / (1 + z * z / trials)
    half = z / (1 + z * z / trials) * math.sqrt(
        rate * (1 - rate) / trials + z * z / (4 * trials * trials))
    return middle - half, middle + half


class Errors:
    """Errors of the frames of one or several runs: meters and radians."""

    def __init__(self, rows, lost, frames):
        self.stamp = np.array([row["stamp"] for row in rows])
        self.translation = np.array([row["translation_m"] for row in rows])
        self.rotation = np.array([row["rotation_rad"] for row in rows])
        self.lost = lost
        self.frames = frames


class Basin:
    """Success over magnitude."""

    def __init__(self, rows):
        self.magnitude = np.array([row["magnitude"] for row in rows])
        self.trials = np.array([row["trials"] for row in rows])
        self.successes = np.array([row["successes"] for row in rows])
        self.milliseconds = np.array([row["milliseconds_mean"] for row in rows])
        self.rate = self.successes / self.trials

    def interval(self):
        pairs = [wilson(s, n) for s, n in zip(self.successes, self.trials)]
        return np.array([low for low, _ in pairs]), np.array([high for _, high in pairs])

    def mean(self):
        """Success over all magnitudes."""
        return float(self.rate.mean())

    def variance(self):
        """Of mean()."""
        return float((self.rate * (1 - self.rate) / self.trials).sum()) / len(self.rate) ** 2


class Results:
    """Results of the experiments in an output folder."""

    def __init__(self, experiments, folder):
        self.experiments = experiments
        self.folder = folder

    def errors(self, kind, keys, method):
        """Errors of a method's runs over some sequences, one after the other."""
        rows, lost, frames = [], 0, 0
        for key in keys:
            path = lambda ending: self.folder.file(
                self.experiments.run_path(kind, key, method.key, ending))
            rows += read_rows(path("csv"))
            summary = read_value_file(path("summary"))
            lost += int(summary["lost"])
            frames += int(summary["frames"])
        return Errors(rows, lost, frames)

    def evaluation(self, key, method_key):
        """Figures of evaluate_trajectory and of the run itself, by name."""
        path = lambda ending: self.folder.file(
            self.experiments.run_path("drift", key, method_key, ending))
        with open(path("json"), encoding="utf-8") as figures:
            result = json.load(figures)
        result.update({name: float(value) for name, value in read_value_file(path("summary")).items()})
        return result

    def basin(self, method, relit=False):
        return Basin(read_rows(self.folder.file(
            self.experiments.convergence_path(method.key, relit))))

    def optimizer(self, name):
        """Trials of one optimizer by magnitude."""
        trials = {}
        for row in read_rows(self.folder.file(self.experiments.optimizer_path(name))):
            trials.setdefault(row["magnitude"], []).append(row)
        return trials

    def level_times(self):
        """What the speed benchmark makes its Table I of, too, the first frame left out as there."""
        rows = {}
        for method in TIMED:
            paths = [self.folder.file(self.experiments.level_path(method, repetition) + ".csv")
                     for repetition in range(self.experiments.plan.repetitions)]
            rows[method] = by_frame([read_rows(path)[1:] for path in paths])
        return rows

    def tracking_time(self, method):
        """Mean over the frames of the time on all levels, ms."""
        return float(np.mean(level_sums(self.level_times()[method.key])))

    def picture(self, name, image):
        return self.folder.file(self.experiments.picture_path(name, image))

    def picture_summary(self, name):
        return read_value_file(self.folder.file("pictures", name + ".summary"))

    def illuminance(self, key):
        """Seconds and lux of each frame of a sequence."""
        path = self.folder.file(self.experiments.sequence(key), "exposure.txt")
        values = np.loadtxt(path, ndmin=2)
        return values[:, 0], values[:, 1]

    def table_2(self, method):
        """(trajectory, lighting): errors."""
        return {case: self.errors("moving", keys, method)
                for case, keys in self.experiments.plan.table_2.items()}

    def variants(self):
        """(key, title) of all rows of the tables beyond the paper."""
        rows = [(method.key, method.title) for method in self.experiments.variants]
        if self.experiments.has_peers:
            rows += [("peer_" + peer, title) for peer, title in plans.PEERS]
        return rows
