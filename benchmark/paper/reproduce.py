# SPDX-License-Identifier: BSD-3-Clause
"""The command line of scripts/reproduce_paper."""

import argparse
import os
import sys

import plan as plans
from experiments import FOLDERS, Experiments
from jobs import Folder, JobError, run_jobs
from report import Report
from results import Results

NEEDED = ("generate_sequence", "run_sequence", "evaluate_trajectory", "pose_errors",
          "convergence_experiment", "tracking_pictures")


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


def find_recordings():
    """Sequence folders with truth in $MIVO_DATA, by a name for files."""
    root = os.environ.get("MIVO_DATA", "")
    if not root:
        return {}
    if not os.path.isdir(root):
        raise JobError("MIVO_DATA: there is no folder '%s'" % root)
    return {"recording_" + name: os.path.join(os.path.abspath(root), name)
            for name in sorted(os.listdir(root))
            if os.path.exists(os.path.join(root, name, "groundtruth.txt"))}


def find_programs(build):
    folder = os.path.join(os.path.abspath(build), "bin")
    for name in NEEDED:
        if not os.path.exists(os.path.join(folder, name)):
            raise JobError("there is no %s in %s: build with scripts/build -DMIVO_WITH_BENCHMARKS=ON"
                           % (name, folder))
    return folder


def run(options):
    plan = plans.Plan(options.quick)
    output = options.output or os.path.join(plans.ROOT, "paper_output",
                                            "quick" if options.quick else "full")
    document = options.document or (output if options.quick else os.path.join(plans.ROOT, "doc"))
    experiments = Experiments(plan, find_programs(options.build), find_recordings(),
                              options.paper_only)
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
    except JobError as error:
        sys.stderr.write("reproduce_paper: %s\n" % " ".join(str(error).split()))
        return 1
    except KeyboardInterrupt:
        sys.stderr.write("reproduce_paper: interrupted; what is done is kept\n")
        return 1
    return 0
