# SPDX-License-Identifier: BSD-3-Clause
"""Which cost to use on the coarse levels: mutual information, least squares, or both in competition."""

import collections
import os

import models
import sparse
from measuring.jobs import Job
from measuring.methods import words
from measuring.programs import MeasuringError
from measuring.progress import Progress
from measuring.statistics import read_rows, rpe

NO_COMPETITION = {"surprise_deviations": "1000000"}
UNGUIDED = {"hold_coarse_levels": "false", **NO_COMPETITION}
# Name, and the parameters that differ from the default.
VARIANTS = [
    ("MI, as in Algorithm 1", UNGUIDED),
    ("MI, 16 bins, as in Algorithm 1", {"mi_bins": "16", **UNGUIDED}),
    ("SSD, no guidance", {"method": "ssd", **UNGUIDED}),
    ("MI, guided by the motion model", NO_COMPETITION),
    ("SSD, guided by the motion model", {"method": "ssd", **NO_COMPETITION}),
    ("MI, guided, in competition: the default", {}),
    ("SSD, guided, in competition", {"method": "ssd"}),
]
RELIT = ["constant", "ramp_step", "spot", "gamma", "auto_exposure", "inversion"]
MAGNITUDES, QUICK_MAGNITUDES = [0.05, 0.1, 0.2, 0.3, 0.4], [0.1, 0.3]
TRIALS, QUICK_TRIALS = 1000, 50
BASIN_LIGHTS = ["constant", "spot", "inversion"]
IMAGE_ALONE = {"geometric_term": "false"}
RAW_IMAGE_ALONE = {**models.AS_THEY_ARE, **IMAGE_ALONE}
# On normalized images as by default, and on raw intensities as in the paper.
BASIN_VARIANTS = [("MI on coarse levels, lcn", IMAGE_ALONE),
                  ("SSD on all levels, lcn", {"method": "ssd", **IMAGE_ALONE}),
                  ("MI on coarse levels, intensities", RAW_IMAGE_ALONE),
                  ("SSD on all levels, intensities", {"method": "ssd", **RAW_IMAGE_ALONE}),
                  ("default, with depth", {}),
                  ("SSD on all levels, lcn, with depth", {"method": "ssd"})]
HEAD = ["coarse levels", "constant light", "changing light", "lost", "undetected errors"]
TEXT = """
All on locally normalized images. "Guided": the expected motion constrains the coarse levels
(`hold_coarse_levels`). "In competition": a surprising result is compared with those of other starts
(`surprise_deviations`). RPE over 1 s, geometric means, m deg."""
BASIN_TEXT = f"""
Share of starts that end within 0.01 m and 0.01 rad, of {TRIALS} each, over the displacement of the start (norm of
the twist, m and rad): `convergence_experiment` on pairs of a synthetic room, the live image as it is or relit
(inversion: half of the live images are negatives)."""


def coarse(bench):
    for kind in models.TITLE:
        tasks = [task for task in all_tasks(bench) if task[0] == kind]
        if tasks:
            bench.say_table(f"Coarse levels, {models.TITLE[kind]}", HEAD, light_rows(bench, tasks),
                            TEXT)
    bench.say_table("Coarse levels, sparse scenes",
                    ["coarse levels", "frames", "undetected errors", "lost", "degraded"],
                    sparse_rows(bench), f"\n{len(seeds(bench))} seeds each of {', '.join(scenes(bench))}.")
    magnitudes = QUICK_MAGNITUDES if bench.options.quick else MAGNITUDES
    bench.say_table("Coarse levels, basin of convergence",
                    ["variant", "live image"] + [f"{magnitude:g}" for magnitude in magnitudes],
                    basin_rows(bench, magnitudes), BASIN_TEXT)


def all_tasks(bench):
    return models.filmed_tasks(bench) + [
        ("recordings", os.path.basename(recording), light,
         lambda r=recording, n=light: bench.relit(r, n))
        for recording in bench.recordings() for light in models.lights(bench, RELIT)]


def variants(bench):
    return VARIANTS[-2:] if bench.options.quick else VARIANTS


def light_rows(bench, tasks):
    rows, progress = [], Progress(len(tasks) * len(variants(bench)), "runs of coarse levels")
    for name, settings in variants(bench):
        runs, wrong = [], 0
        for kind, sequence, light, make in tasks:
            folder = make()
            figures = bench.run("mivo", folder, *words(settings))
            runs.append(models.Run(kind, name, sequence, light, *rpe(figures), int(figures["lost"])))
            wrong += int(bench.wrong(figures, folder))
            progress.step(f"{name}, {sequence} {light}")
        rows.append([name, models.middle([one for one in runs if one.light == "constant"]),
                     models.middle([one for one in runs if one.light != "constant"]),
                     str(sum(one.lost for one in runs)), str(wrong)])
    progress.close()
    return rows


def scenes(bench):
    return sparse.QUICK_SCENES if bench.options.quick else sparse.SCENES


def seeds(bench):
    return sparse.SEEDS[:1] if bench.options.quick else sparse.SEEDS


def sparse_rows(bench):
    rows = []
    for name, settings in variants(bench):
        sums = collections.Counter()
        for scene in scenes(bench):
            for seed in seeds(bench):
                folder = sparse.film(bench, scene, seed)
                sums.update(sparse.count(bench.track("mivo", folder, *words(settings)), folder))
        rows.append([name] + [str(sums[key]) for key in ("frames", "undetected errors", "lost",
                                                         "degraded")])
    return rows


def basin_rows(bench, magnitudes):
    room = bench.filmed("room", 1, "figure_of_eight", "constant")
    rows = []
    for name, settings in BASIN_VARIANTS:
        for light in BASIN_LIGHTS:
            live = bench.relit(room, light)
            rows.append([name, light] + basin(bench, name, settings, room, live, magnitudes))
    return rows


def basin(bench, name, settings, room, live, magnitudes):
    trials = QUICK_TRIALS if bench.options.quick else TRIALS
    path = bench.results.file("runs", f"basin-{name.replace(' ', '_').replace(',', '')}-"
                              f"{os.path.basename(live)}.csv")
    command = [bench.programs.path("convergence_experiment"), room, "--output", path, "--force",
               "--trials", str(trials), "--live", live] + words(settings)
    for magnitude in magnitudes:
        command += ["--magnitude", str(magnitude)]
    bench.results.run_once(Job("basin/" + os.path.basename(path), [command], sequences=[room, live]))
    rows = read_rows(path)
    if len(rows) != len(magnitudes):
        raise MeasuringError(f"{path}: {len(rows)} rows instead of {len(magnitudes)}")
    return [f"{100.0 * row['successes'] / row['trials']:.1f} %" for row in rows]
