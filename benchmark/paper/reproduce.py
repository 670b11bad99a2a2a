# SPDX-License-Identifier: BSD-3-Clause
"""The command line of scripts/reproduce_paper."""

import argparse
import os
import sys

import plan as plans  # finds the modules of measuring
from experiments import FOLDERS, Experiments
from measuring.jobs import Folder, run_jobs
from measuring.programs import MeasuringError, Programs
from measuring.sequences import find_recordings
from report import Report
from results import Results

def arguments():
    parser = argparse.ArgumentParser(
        prog="reproduce_paper",
        description="Films the sequences, runs the experiments of the paper's section IV, and writes "
                    "results.md with tables and plots. What is done is not done again: start it once "
                    "more after an interruption. Recordings in $MIVO_DATA are tracked, too.")
    parser.add_argument("--quick", action="store_true",
                        help="small and few frames: whether it works, not what is true")
    parser.add_argument("--paper-only", action="store_true",
                        help="without other variants, OpenCV's odometries and recordings")
    parser.add_argument("--build", default=os.path.join(plans.ROOT, "build"), metavar="FOLDER",
                        help="build with MIVO_WITH_BENCHMARKS (default: build)")
    parser.add_argument("--output", metavar="FOLDER",
                        help="for sequences and results (default: paper_output, with --quick "
                             "paper_output/quick)")
    parser.add_argument("--document", metavar="FOLDER",
                        help="for results.md and its figures (default: doc, with --quick the "
                             "output folder)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N",
                        help="programs at once (default: one per core)")
    options = parser.parse_args()
    if options.jobs < 1:
        parser.error("--jobs must be 1 at least")
    return options


def run(options):
    plan = plans.Plan(options.quick)
    output = options.output or os.path.join(plans.ROOT, "paper_output",
                                            "quick" if options.quick else "full")
    document = options.document or (output if options.quick else os.path.join(plans.ROOT, "doc"))
    recordings = {"recording_" + name: path  # a name for files
                  for name, path in find_recordings("groundtruth.txt").items()}
    experiments = Experiments(plan, Programs(options.build), recordings, options.paper_only)
    folder = Folder(os.path.abspath(output))
    for name in FOLDERS:
        os.makedirs(folder.file(name), exist_ok=True)
    run_jobs(experiments.jobs, folder, options.jobs)
    path = Report(Results(experiments, folder), document).write()
    print(os.path.relpath(path))


def main():
    options = arguments()
    try:
        run(options)
    except MeasuringError as error:
        sys.stderr.write("reproduce_paper: %s\n" % " ".join(str(error).split()))
        return 1
    except KeyboardInterrupt:
        sys.stderr.write("reproduce_paper: interrupted; what is done is kept\n")
        return 1
    return 0
