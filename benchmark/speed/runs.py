# SPDX-License-Identifier: BSD-3-Clause
"""Runs that measure time."""

import json
import os

from measuring import sequences
from measuring.statistics import read_rows, read_values


class Runs:
    """Runs the programs of a build; what they write goes to a folder."""

    def __init__(self, programs, output):
        self.programs = programs
        self.output = output
        os.makedirs(output, exist_ok=True)

    def film(self, name, *options):
        """Folder of a generated sequence."""
        return sequences.generate(self.programs, os.path.join(self.output, name), *options)

    def track(self, sequence, count, *options):
        """Rows of the statistics of a run on one thread, without the first frame."""
        base = os.path.join(self.output, "run")
        self.programs.run("run_sequence", sequence, "--output", base + ".txt", "--statistics",
                          base + ".csv", "--force", "--threads", "1", "--count", count, *options)
        return read_rows(base + ".csv")[1:]

    def peer(self, sequence, count, method):
        """Median processor time of one of OpenCV's odometries, milliseconds."""
        text = self.programs.run("run_peer", sequence, "--output",
                                 os.path.join(self.output, "peer.txt"), "--force", "--method",
                                 method, "--count", count)
        return float(read_values(text)["cpu_ms_median"])

    def kernels(self, seconds):
        """Nanoseconds per call: {kernel: {backend: value}}."""
        text = self.programs.run("kernels_benchmark", "--benchmark_format=json",
                                 "--benchmark_min_time=%g" % seconds, "--benchmark_repetitions=3")
        times = {}
        for entry in json.loads(text)["benchmarks"]:
            if entry.get("aggregate_name") == "median":
                kernel, backend = entry["run_name"].split("/")[:2]
                times.setdefault(kernel, {})[backend] = entry["cpu_time"]
        return times
