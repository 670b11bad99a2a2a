#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Robustness of mivo, the paper's methods and OpenCV's odometries to light, darkness and loss.

    scripts/benchmark robustness [--quick] [--document] [--only PART]... [--methods NAME]...

Renders and relights the sequences, runs every method on them and prints the tables of
doc/robustness.md. Sequences and runs are reused when neither input nor program has changed.
"""

import argparse
import datetime
import os
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.append(os.path.dirname(HERE))

import chance  # noqa: E402  they need the path above
import coarse  # noqa: E402
import covariance  # noqa: E402
import darkness  # noqa: E402
import degenerate  # noqa: E402
import false_losses  # noqa: E402
import gaps  # noqa: E402
import light  # noqa: E402
import loss  # noqa: E402
import models  # noqa: E402
import shutter  # noqa: E402
import sparse  # noqa: E402
import still  # noqa: E402
from bench import METHODS, Bench  # noqa: E402
from measuring import machine  # noqa: E402
from measuring.programs import MeasuringError  # noqa: E402


def compared(bench):
    """mivo on lcn, on intensities, and on other maps of the images."""
    for title, head, rows in models.tables(bench):
        bench.say_table(title, head, rows)


def shutters(bench):
    """Ten seeds with and without a rolling shutter, also in recordings that disagree."""
    bench.say_table("Read-out time", shutter.HEAD, shutter.rows(bench), shutter.TEXT)
    bench.say_table("Read-out time of recordings that disagree", shutter.DISTURBED_HEAD,
                    shutter.disturbed_rows(bench), shutter.DISTURBED_TEXT)


PARTS = {"light": light.light, "darkness": darkness.darkness, "loss": loss.loss,
         "static": still.static, "rest": still.rest, "covariance": covariance.covariance,
         "sparse": sparse.sparse, "degenerate": degenerate.degenerate, "gaps": gaps.gaps,
         "chance": chance.chance, "false_losses": false_losses.count, "shutter": shutters,
         "models": compared, "coarse": coarse.coarse}


def document(bench):
    """Writes doc/robustness.md: the remarks, then the tables of this run."""
    with open(os.path.join(HERE, "remarks.md"), encoding="utf-8") as file:
        remarks = file.read()
    with open(os.path.join(ROOT, "doc", "robustness.md"), "w", encoding="utf-8") as file:
        file.write(remarks + f"\n`scripts/benchmark robustness --document`, {datetime.date.today()}, "
                   f"{machine.processor()}.\n" + "\n".join(bench.lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true",
                        help="one scene and path, short sequences of small images")
    parser.add_argument("--build", default="build", metavar="FOLDER")
    parser.add_argument("--output", default="benchmark_output/robustness", metavar="FOLDER")
    parser.add_argument("--document", action="store_true", help="write doc/robustness.md, too")
    parser.add_argument("--only", action="append", choices=list(PARTS), metavar="PART",
                        help=f"one of {', '.join(PARTS)}; may be repeated")
    parser.add_argument("--methods", action="append", choices=list(METHODS), metavar="NAME",
                        help=f"one of {', '.join(METHODS)}; may be repeated")
    bench = Bench(parser.parse_args())
    try:
        for part in bench.options.only or PARTS:
            PARTS[part](bench)
    except MeasuringError as error:
        sys.exit(f"robustness: {error}")
    if bench.options.document:
        document(bench)


if __name__ == "__main__":
    main()
