# SPDX-License-Identifier: BSD-3-Clause
"""The command line of scripts/benchmark speed."""

import argparse
import os
import sys

BENCHMARK = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
ROOT = os.path.dirname(BENCHMARK)
sys.path.append(BENCHMARK)

import measure  # noqa: E402
import plots  # noqa: E402
import tables  # noqa: E402
from measuring import machine  # noqa: E402  found by the path above
from measuring.methods import TIMED  # noqa: E402
from measuring.programs import MeasuringError, Programs  # noqa: E402
from measuring.tables import level_table  # noqa: E402
from runs import Runs  # noqa: E402

INTRODUCTION = """# Speed

Made by `scripts/benchmark speed --document` on %s, %d cores. Processor time on one
thread from decoded 8-bit image and 16-bit depth to the pose, keyframes and undistortion included. Runs
take turns and each figure is the median over %d of them; what else the machine did is in the
milliseconds, but hardly in the ratios. SSD, MI and hybrid are the paper's (`photometric_model: none`,
`geometric_term: false`, `rolling_shutter_estimation: false`, `hold_coarse_levels: false`, `surprise_deviations: 1000000`); default is what a user gets.
"""
BACKENDS = """The hot loops are functions over plain arrays (`include/mivo/core/kernels/kernels.h`) with a readable
reference in plain C++ and one vector source for SSE4, AVX2, AVX-512 and NEON. The processor decides
which runs when the program starts: nothing is built for one machine (`kernels::backends()`,
`kernels::select()`). Tests hold each of them against the reference. Points are 4800, images 640 x 480.
"""


def arguments():
    parser = argparse.ArgumentParser(prog="benchmark speed", description=__doc__)
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), metavar="FOLDER")
    parser.add_argument("--output", default=os.path.join(ROOT, "benchmark_output"),
                        metavar="FOLDER", help="for sequences, speed.md and plots")
    parser.add_argument("--quick", action="store_true", help="few frames: whether it works")
    parser.add_argument("--repetitions", type=int, metavar="N",
                        help="runs of which the median counts (default 3, quick 1)")
    parser.add_argument("--document", action="store_true", help="write doc/speed.md, too")
    options = parser.parse_args()
    if options.repetitions is not None and options.repetitions < 1:
        parser.error("--repetitions must be 1 at least")
    return options


def say(text):
    print(text, file=sys.stderr, flush=True)


def measure_all(runs, plan, folder):
    say("filming ...")
    sequences = {}
    for name, path in measure.find_sequences(runs, plan).items():
        say("measuring %s ..." % name)
        sequences[name] = measure.measure_sequence(runs, plan, path)
        plots.plot_levels(folder, name, sequences[name])
        plots.plot_frames(folder, name, sequences[name])
    room = os.path.join(folder, "room")
    say("measuring kernels ...")
    kernels = runs.kernels(plan.kernel_seconds)
    say("measuring image sizes, points and bins ...")
    sizes = measure.measure_sizes(runs, plan)
    points = measure.measure_parameter(runs, plan, room, "point_fraction", measure.FRACTIONS, ())
    bins = measure.measure_parameter(runs, plan, room, "mi_bins", measure.BINS, TIMED["mi"])
    plots.plot_sizes(folder, sizes)
    plots.plot_parameter(folder, "point_fraction", points)
    plots.plot_parameter(folder, "mi_bins", bins)
    return sequences, kernels, sizes, points, bins


def document(plan, sequences, kernels, sizes, points, bins):
    parts = [INTRODUCTION % (machine.processor(), machine.cores(), plan.repetitions),
             "## Against the goals\n", tables.goal_table(sequences),
             "## Median time per frame, ms\n", tables.median_table(sequences)]
    for name, measured in sequences.items():
        parts += ["## %s\n" % name, "By stage, default:\n", tables.stage_table(measured),
                  "By level, ms, mean ± standard deviation (the paper's Table I):\n",
                  level_table(measured["rows"])]
    parts += ["## Kernels\n", BACKENDS, tables.kernel_table(kernels),
              "## Cost against resolution, points and bins\n",
              "Median ms per frame by image width (4:3):\n", tables.size_table(sizes),
              "Default, by the fraction of pixels that become points:\n",
              tables.parameter_table("`point_fraction`", points), "MI on all levels, by bins:\n",
              tables.parameter_table("`mi_bins`", bins)]
    return "\n".join(parts)


def main():
    options = arguments()
    plan = measure.Plan(options.quick)
    if options.repetitions is not None:
        plan.repetitions = options.repetitions
    folder = os.path.abspath(options.output)
    try:
        runs = Runs(Programs(options.build), folder)
        text = document(plan, *measure_all(runs, plan, folder))
    except MeasuringError as error:
        say("benchmark speed: %s" % error)
        return 1
    targets = [os.path.join(folder, "speed.md")]
    if options.document:
        targets.append(os.path.join(ROOT, "doc", "speed.md"))
    for target in targets:
        with open(target, "w", encoding="utf-8") as file:
            file.write(text)
    print(text)
    say("speed.md and plots are in %s" % folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
