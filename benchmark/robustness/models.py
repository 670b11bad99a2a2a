# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of photometric models: the same tracker on local contrast normalization, on raw
intensities, and on images mapped beforehand."""

import collections
import os

import image_maps
from measuring.methods import words
from measuring.progress import Progress
from measuring.statistics import geometric_mean, rpe

AS_THEY_ARE = {"photometric_model": "none"}
# What is compared: a name, the map of the images made beforehand, and parameters that differ from
# the default.
MODELS = [
    ("intensities as they are", None, AS_THEY_ARE),
    ("histogram equalized", image_maps.equalized, AS_THEY_ARE),
    ("gain and bias of the frame", image_maps.gain_and_bias, AS_THEY_ARE),
    ("local mean removed", image_maps.local_mean_removed, AS_THEY_ARE),
    ("gradient magnitude", image_maps.gradient_magnitude, AS_THEY_ARE),
    ("rank among neighbors", image_maps.rank, AS_THEY_ARE),
    ("locally normalized image", image_maps.locally_normalized, AS_THEY_ARE),
    ("lcn, the default", None, {}),
    ("intensities, mi on all levels", None, {"method": "mi", **AS_THEY_ARE}),
    ("lcn, mi on all levels", None, {"method": "mi"}),
    ("lcn, ssd on all levels", None, {"method": "ssd"}),
]
SCENES = ["room", "office"]
PATHS = ["rotation", "figure_of_eight"]
FILMED_LIGHT = ["constant", "ramp_step", "moving_lamp", "left_right", "auto_exposure"]
RELIT = ["constant", "ramp_step", "spot", "gamma", "auto_exposure"]
FEW = 2  # lights of a quick run
EVERY = 3  # of its models only so many: both kinds of map, and of parameters
TITLE = {"filmed": "synthetic", "recordings": "recordings"}
HEAD = ["what is compared", "constant light", "changing light", "worst sequence", "lost frames"]

# What a run gave, and of which sequence.
Run = collections.namedtuple("Run", "kind model sequence light meters degrees lost")


def tables(bench):
    """(title, head, rows) for filmed sequences, and for recordings if there are any."""
    tasks = filmed_tasks(bench) + recorded_tasks(bench)
    models = MODELS[::EVERY] if bench.options.quick else MODELS
    progress = Progress(len(tasks) * len(models), "runs of models")
    runs = []
    for kind, sequence, light, make in tasks:
        source = make()
        for model in models:
            figures = run(bench, source, model)
            runs.append(Run(kind, model[0], sequence, light, *rpe(figures), int(figures["lost"])))
            progress.step(f"{sequence} {light}, {model[0]}")
    progress.close()
    return [(f"What is compared, {TITLE[kind]}: RPE over 1 s, m deg", HEAD,
             rows_of([one for one in runs if one.kind == kind]))
            for kind in dict.fromkeys(task[0] for task in tasks)]


def filmed_tasks(bench):
    """(kind, sequence, light, what makes the folder) each."""
    return [("filmed", f"{scene} {path}", light,
             lambda s=scene, e=seed, p=path, n=light: bench.filmed(s, e, p, n))
            for scene, seed in bench.scenes if scene in SCENES
            for path in bench.paths if path in PATHS
            for light in lights(bench, FILMED_LIGHT)]


def recorded_tasks(bench):
    return [("recordings", os.path.basename(recording), light,
             lambda r=recording, n=light: bench.relit(r, n))
            for recording in bench.recordings()
            for light in lights(bench, RELIT)]


def lights(bench, names):
    return names[:FEW] if bench.options.quick else names


def run(bench, source, model):
    _, image_map, settings = model
    folder = source
    if image_map is not None:
        name = f"{os.path.basename(source)}_{image_map.__name__}"
        folder = image_maps.mapped(bench.folder(name), source, image_map)
    return bench.run("mivo", folder, *words(settings))


def rows_of(runs):
    """A row for each model, in their order."""
    return [[name] + summary([one for one in runs if one.model == name])
            for name in dict.fromkeys(one.model for one in runs)]


def summary(runs):
    """Geometric means under constant and under changing light, the worst, all that were lost."""
    worst = max(runs, key=lambda one: one.meters)
    return [middle([one for one in runs if one.light == "constant"]),
            middle([one for one in runs if one.light != "constant"]),
            f"{worst.meters:.4f} {worst.degrees:.3f} {worst.sequence} {worst.light}",
            str(sum(one.lost for one in runs))]


def middle(runs):
    """Geometric means: one sequence that is lost does not hide the others."""
    return "{:.4f} {:.3f}".format(geometric_mean([one.meters for one in runs]),
                                  geometric_mean([one.degrees for one in runs]))
