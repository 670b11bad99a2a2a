# SPDX-License-Identifier: BSD-3-Clause
"""Runs mivo's programs and reads what they print and write."""

import csv
import json
import os
import subprocess


class ProgramError(Exception):
    """A program failed; the text says which and why."""


class Programs:
    """The programs of one build, and a folder for what they write."""

    def __init__(self, build, output):
        self.folder = os.path.join(os.path.abspath(build), "bin")
        self.output = output
        os.makedirs(output, exist_ok=True)

    def run(self, name, *arguments):
        """Output of a program as text."""
        path = os.path.join(self.folder, name)
        if not os.path.exists(path):
            raise ProgramError("there is no %s in %s: build with scripts/build "
                               "-DMIVO_WITH_BENCHMARKS=ON" % (name, self.folder))
        done = subprocess.run([path] + list(arguments), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, check=False)
        if done.returncode != 0:
            raise ProgramError("%s %s: exit code %d: %s"
                               % (name, " ".join(arguments), done.returncode, done.stderr.strip()))
        return done.stdout

    def film(self, name, *options):
        """Folder of a generated sequence; one that is there already is taken as it is."""
        folder = os.path.join(self.output, name)
        recipe = os.path.join(self.output, name + ".options")
        text = " ".join(options)
        if os.path.exists(recipe):
            with open(recipe, encoding="utf-8") as file:
                if file.read() == text:
                    return folder
        self.run("generate_sequence", folder, "--force", *options)
        with open(recipe, "w", encoding="utf-8") as file:
            file.write(text)
        return folder

    def track(self, sequence, count, *options):
        """Rows of the statistics of a run on one thread, without the first frame."""
        base = os.path.join(self.output, "run")
        self.run("run_sequence", sequence, "--output", base + ".txt", "--statistics", base + ".csv",
                 "--force", "--threads", "1", "--count", str(count), *options)
        return read_rows(base + ".csv")[1:]

    def peer(self, sequence, count, method):
        """Median processor time of one of OpenCV's odometries, milliseconds."""
        text = self.run("run_peer", sequence, "--output", os.path.join(self.output, "peer.txt"),
                        "--force", "--method", method, "--count", str(count))
        return float(read_values(text)["cpu_ms_median"])

    def kernels(self, seconds):
        """Nanoseconds per call: {kernel: {backend: value}}."""
        text = self.run("kernels_benchmark", "--benchmark_format=json",
                        "--benchmark_min_time=%g" % seconds, "--benchmark_repetitions=3")
        times = {}
        for entry in json.loads(text)["benchmarks"]:
            if entry.get("aggregate_name") == "median":
                kernel, backend = entry["run_name"].split("/")[:2]
                times.setdefault(kernel, {})[backend] = entry["cpu_time"]
        return times


def read_values(text):
    """Lines `name: value`."""
    return dict(line.split(": ", 1) for line in text.splitlines() if ": " in line)


def read_rows(path):
    """Rows of statistics: numbers where they are numbers."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(path, encoding="utf-8") as table:
        return [{name: value(text) for name, text in row.items()} for row in csv.DictReader(table)]
