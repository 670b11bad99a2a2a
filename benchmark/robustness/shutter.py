# SPDX-License-Identifier: BSD-3-Clause
"""Estimation of the read-out time, with a rolling and a global shutter."""

from measuring import sequences
from measuring.progress import Progress
from measuring.statistics import column, read_rows, read_value_file

SCENES = ("room", "office", "corridor")
PATHS = ("rotation", "fast_rotation", "figure_of_eight")
SEEDS = range(11, 21)
READOUT_S = 0.02
HEAD = ["sequence", "global: found, longest ms", "rolling: found ms",
        "RPE global", "RPE rolling: found", "given", "ignored"]
TEXT = f"""
Ten seeds, each rendered with a global shutter and with {1e3 * READOUT_S:.0f} ms from the first row to the last; scenes and
paths alternate. "found": estimate of the read-out time at the end; "longest": largest estimate during the
run. RPE over 1 s in m of all frames, including those before the estimate is available."""


def film(bench, seed, readout):
    """A sequence without blur that renders quickly."""
    scene, path = SCENES[seed % 3], PATHS[seed // 3 % 3]
    name = f"shutter{seed}_{scene}_{path}_{1000 * readout:.0f}_{bench.frames}"
    return sequences.generate(bench.programs, bench.folder(name), "--frames", bench.frames,
                              "--scene", scene, "--trajectory", path, "--seed", seed,
                              "--readout", readout, "--no-blur", "--samples", 1, *bench.size)


def longest(figures):
    """Largest estimate of the read-out time during a run, ms."""
    return 1e3 * max(column(read_rows(figures["base"] + ".csv"), "rolling_shutter_readout"))


def at_the_end(figures):
    """The read-out time of a run's last frame, ms."""
    return 1e3 * float(read_value_file(figures["base"] + ".summary")["rolling_shutter_readout_s"])


def error(figures):
    return "{:.4f}".format(float(figures["rpe_translation_rmse_m"]))


def row_of(bench, seed):
    still, rolling = film(bench, seed, 0), film(bench, seed, READOUT_S)
    at_once, found = bench.run("mivo", still), bench.run("mivo", rolling)
    given = bench.run("mivo", rolling, "--set", f"rolling_shutter_readout={READOUT_S}")
    ignored = bench.run("mivo", rolling, "--set", "rolling_shutter_estimation=false")
    return [f"{SCENES[seed % 3]}{seed} {PATHS[seed // 3 % 3]}", f"{longest(at_once):.1f}",
            f"{at_the_end(found):.1f}"] + [error(run) for run in (at_once, found, given, ignored)]


def rows(bench):
    """One for each seed."""
    seeds = SEEDS[:1] if bench.options.quick else SEEDS
    table, progress = [], Progress(len(seeds), "shutters")
    for seed in seeds:
        table.append(row_of(bench, seed))
        progress.step(table[-1][0])
    progress.close()
    return table
