# SPDX-License-Identifier: BSD-3-Clause
"""Estimation of the read-out time, with a rolling and a global shutter."""

import os

from measuring import keys, sequences
from measuring.progress import Progress
from measuring.statistics import column, geometric_mean, read_rows, read_value_file

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

DISTURBED_HEAD = ["shutter", "recorded", "found, longest ms", "rotation per frame: mean", "worst",
                  "translation over 1 s: mean", "worst"]
DISTURBED_TEXT = """
The same sequences where stamps, color and depth disagree, as in some data sets: errors with the estimate
divided by those without it, geometric mean and worst of the ten. "Late": each depth image is the one before."""
# What is done to a recording: every tenth color image is the one before, depth is a frame late.
DISTURBANCES = {"as rendered": (False, False), "a tenth of the color images repeated": (True, False),
                "depth late": (False, True), "both": (True, True)}


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


def disturbed(source, repeats_color, is_late):
    """A sequence with the images of another one in other places."""
    if not (repeats_color or is_late):
        return source
    folder = source + "_repeated" * repeats_color + "_late" * is_late

    def make():
        os.makedirs(folder)
        write_list(source, folder, "rgb.txt", lambda i: repeats_color and i % 10 == 9)
        write_list(source, folder, "depth.txt", lambda i: is_late and i > 0)
        for name in ("camera.txt", "groundtruth.txt"):
            os.symlink(os.path.join(source, name), os.path.join(folder, name))

    return sequences.make_once(folder, ["disturbed", keys.sequence_key(source), repeats_color, is_late],
                               make)


def write_list(source, folder, name, takes_one_before):
    """The list of a sequence's images, some of them replaced by the one before."""
    with open(os.path.join(source, name), encoding="utf-8") as file:
        entries = [line.split() for line in file if line.strip() and not line.startswith("#")]
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        for i, (stamp, _) in enumerate(entries):
            image = entries[i - 1 if takes_one_before(i) else i][1]
            file.write(f"{stamp} {os.path.relpath(os.path.join(source, image), folder)}\n")


def disturbed_rows(bench):
    """One for each shutter and disturbance, over all seeds."""
    seeds = SEEDS[:1] if bench.options.quick else SEEDS
    table, progress = [], Progress(2 * len(DISTURBANCES), "disagreeing recordings")
    for shutter, readout in (("global", 0), ("rolling", READOUT_S)):
        for disturbance, what in DISTURBANCES.items():
            folders = [disturbed(film(bench, seed, readout), *what) for seed in seeds]
            found = [bench.run("mivo", folder) for folder in folders]
            without = [bench.run("mivo", folder, "--set", "rolling_shutter_estimation=false")
                       for folder in folders]
            table.append([shutter, disturbance, f"{max(longest(run) for run in found):.1f}"]
                         + ratios(found, without, "rpe_frame_rotation_rmse_deg")
                         + ratios(found, without, "rpe_translation_rmse_m"))
            progress.step(f"{shutter}, {disturbance}")
    progress.close()
    return table


def ratios(found, without, name):
    """Geometric mean and largest of the ratios of a figure."""
    of_runs = [float(one[name]) / float(other[name]) for one, other in zip(found, without)]
    return [f"{geometric_mean(of_runs):.2f}", f"{max(of_runs):.2f}"]
