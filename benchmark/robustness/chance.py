# SPDX-License-Identifier: BSD-3-Clause
"""Unrelated noise images, which no method may accept, and good pairs, which none may reject."""

import os

import cv2
import numpy as np

from bench import FILMED_LIGHT
from measuring import keys
from measuring.progress import Progress
from measuring.sequences import make_once
from measuring.statistics import read_rows
from measuring.tracks import MEASURED

SIZES = [(160, 120), (320, 240), (640, 480)]
BINS = [4, 8, 16, 32, 64]
METHODS = ["mi", "hybrid", "ssd"]  # the last has no bins
SMOOTH_SIGMA = {"white": 0.0, "smooth": 3.0}  # pixels
GRAY_MEAN, GRAY_DEVIATION = 128.0, 40.0
PAIRS, QUICK_PAIRS = 50, 5
DEPTH_MM = 2000
HEAD = ["noise", "size", "method", "mi_bins", "photometric_model", "pairs", "accepted"]
TEXT = f"""
{PAIRS} noise images against a first one, white or smoothed by a Gaussian of {SMOOTH_SIGMA["smooth"]:.0f} pixels, with constant depth that is
not aligned (`geometric_term: false`). Accepted: state tracking or degraded."""


def chance(bench):
    rows = []
    tasks = [(kind, size) for kind in SMOOTH_SIGMA for size in SIZES]
    tasks = tasks[:1] if bench.options.quick else tasks
    progress = Progress(len(tasks), "kinds of noise")
    for kind, size in tasks:
        folder = film(bench, kind, size)
        rows += [row_of(bench, folder, kind, size, *settings) for settings in all_settings(bench)]
        progress.step(f"{kind} {size[0]}")
    progress.close()
    bench.say_table("Unrelated noise images", HEAD, rows, TEXT)
    good_pairs(bench)


def all_settings(bench):
    """(method, bins, photometric model) each."""
    bins = [16] if bench.options.quick else BINS
    return [(method, number, model) for method in METHODS for model in ("none", "lcn")
            for number in (bins if method != "ssd" else [8])]


def row_of(bench, folder, kind, size, method, bins, model):
    frames = bench.track("mivo", folder, "--reference", "first", "--method", method,
                         "--set", f"mi_bins={bins}", "--set", f"photometric_model={model}",
                         "--set", "geometric_term=false")
    accepted = [frame for frame in frames[1:] if frame.state in MEASURED]
    return [kind, f"{size[0]} x {size[1]}", method, "" if method == "ssd" else str(bins), model,
            str(len(frames) - 1), str(len(accepted))]


def film(bench, kind, size):
    pairs = QUICK_PAIRS if bench.options.quick else PAIRS
    folder = bench.folder(f"noise_{kind}_{size[0]}_{pairs}")
    recipe = ["noise", kind, size, pairs, keys.file_key(os.path.realpath(__file__))]
    return make_once(folder, recipe, lambda: write_noise(folder, kind, size, pairs + 1))


def write_noise(folder, kind, size, count):
    os.makedirs(folder)
    random = np.random.default_rng(1)
    cv2.imwrite(os.path.join(folder, "depth.png"), np.full(size[::-1], DEPTH_MM, np.uint16))
    with open(os.path.join(folder, "rgb.txt"), "w", encoding="utf-8") as color, \
            open(os.path.join(folder, "depth.txt"), "w", encoding="utf-8") as depth, \
            open(os.path.join(folder, "camera.txt"), "w", encoding="utf-8") as camera:
        focal = 525.0 * size[0] / 640.0
        camera.write(f"{size[0]} {size[1]} {focal} {focal} {0.5 * (size[0] - 1)} "
                     f"{0.5 * (size[1] - 1)} 1000\n")
        for i in range(count):
            stamp = f"{1000.0 + i / 30.0:.6f}"
            cv2.imwrite(os.path.join(folder, f"{i}.png"), noise(random, kind, size))
            color.write(f"{stamp} {i}.png\n")
            depth.write(f"{stamp} depth.png\n")


def noise(random, kind, size):
    values = random.standard_normal(size[::-1])
    if SMOOTH_SIGMA[kind] > 0.0:
        values = cv2.GaussianBlur(values, (0, 0), SMOOTH_SIGMA[kind])
        values /= values.std()
    return np.clip(np.rint(GRAY_MEAN + GRAY_DEVIATION * values), 0, 255).astype(np.uint8)


def good_pairs(bench):
    """Frames of the filmed sequences, all of which follow well upon one another."""
    lights = FILMED_LIGHT[:1] if bench.options.quick else FILMED_LIGHT
    rows = []
    for light in lights:
        states = [row["state"] for scene, seed in bench.scenes for path in bench.paths
                  for row in read_rows(bench.run("mivo", bench.filmed(scene, seed, path, light))["base"]
                                       + ".csv")[1:]]
        refused = sum(state not in MEASURED for state in states)
        rows.append([light, str(len(states)), str(refused), f"{100.0 * refused / len(states):.2f} %"])
    bench.say_table("Good pairs", ["light", "pairs", "refused", "share"], rows)
