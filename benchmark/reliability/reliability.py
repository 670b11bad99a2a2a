# SPDX-License-Identifier: BSD-3-Clause
"""The command line of scripts/benchmark reliability: tracking under faults."""

import argparse
import os
import subprocess
import sys

BENCHMARK = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
ROOT = os.path.dirname(BENCHMARK)
sys.path.append(BENCHMARK)

from measuring import sequences  # noqa: E402  found by the path above
from measuring.programs import MeasuringError, Programs  # noqa: E402
from measuring.statistics import read_values  # noqa: E402
from measuring.tables import table  # noqa: E402

FILM = ["--width", "160", "--height", "120"]  # small: thousands of runs
HEADING = "## Faults\n"
INTRODUCTION = """
Written by `scripts/benchmark reliability --document`: of the generated room (%d frames of 160 x 120) the second
third is spoiled, in %d runs for each fault with seeds of their own, which hit a tenth, a half or all of these frames.
Crash: the process ends. Hang: a frame takes more than a second. Lies: runs with a frame of state `tracking` that is off
by more than 10 cm or 5 degrees since the start of its segment. Overconfident: runs with one that is off by more than
five of its own standard deviations. Recovery: frames from the end of the fault until the pose is tracked and right, in
the worst run.

"""

REMARK = """
Depth of another frame and another camera's calibration are faults that the images do not tell: the pose stays within
centimeters, but its covariance does not know of them.
"""


def arguments():
    parser = argparse.ArgumentParser(prog="benchmark reliability", description=__doc__)
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), metavar="FOLDER")
    parser.add_argument("--output", default=os.path.join(ROOT, "benchmark_output"),
                        metavar="FOLDER", help="for the sequence and reliability.md")
    parser.add_argument("--quick", action="store_true", help="few and small frames, one run each")
    parser.add_argument("--runs", type=int, metavar="N", help="for each fault (default 100)")
    parser.add_argument("--document", action="store_true", help="write doc/reliability.md, too")
    options = parser.parse_args()
    if options.runs is not None and options.runs < 1:
        parser.error("--runs must be 1 at least")
    return options


def film(programs, folder, quick):
    frames = 30 if quick else 90
    path = os.path.join(folder, "faults_%d" % frames)
    return sequences.generate(programs, path, "--frames", frames, *FILM), frames


def measure(programs, sequence, fault, runs):
    """The row of a fault. A crash of the program is a result."""
    command = [programs.path("fault_experiment"), sequence, "--fault", fault, "--runs", str(runs)]
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            universal_newlines=True, check=False)
    if result.returncode == 1:
        raise MeasuringError("fault_experiment: " + result.stderr.strip())
    if result.returncode != 0:
        return [fault, "signal %d" % -result.returncode, "", "", "", ""]
    values = read_values(result.stdout)
    hang = "no" if float(values["longest_s"]) <= 1.0 else values["longest_s"] + " s"
    return [fault, "no", hang, values["wrong"], values["overconfident"], values["recovery"]]


def document(frames, runs, rows):
    header = ["fault", "crash", "hang", "lies", "overconfident", "recovery, frames"]
    return HEADING + INTRODUCTION % (frames, runs) + table(header, rows) + REMARK


def with_section(text, section):
    """A document with its section of that heading replaced, or added at its end."""
    begin = text.find(HEADING)
    if begin < 0:
        return text.rstrip("\n") + "\n\n" + section
    end = text.find("\n## ", begin + 1)
    return text[:begin] + section + ("" if end < 0 else text[end:])


def main():
    options = arguments()
    folder = os.path.abspath(options.output)
    runs = options.runs or (1 if options.quick else 100)
    os.makedirs(folder, exist_ok=True)
    try:
        programs = Programs(options.build)
        sequence, frames = film(programs, folder, options.quick)
        rows = []
        for fault in programs.run("fault_experiment", sequence, "--list").splitlines():
            print("measuring: %s ..." % fault, file=sys.stderr, flush=True)
            rows.append(measure(programs, sequence, fault, runs))
    except MeasuringError as error:
        print("benchmark reliability: %s" % error, file=sys.stderr)
        return 1
    section = document(frames, runs, rows)
    with open(os.path.join(folder, "reliability.md"), "w", encoding="utf-8") as file:
        file.write(section)
    if options.document:
        path = os.path.join(ROOT, "doc", "reliability.md")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(with_section(text, section))
    print(section)
    return 0


if __name__ == "__main__":
    sys.exit(main())
