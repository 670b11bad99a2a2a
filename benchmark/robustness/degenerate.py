# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that leave directions of motion open: are states and covariances true?"""

import collections

import numpy as np

from bench import SMALL
from judging import in_world, nees
from measuring.progress import Progress
from measuring.statistics import mean, quantile
from measuring.trajectories import covariance_of, size, vector_of
from measuring.tracks import motion
from open_motions import open_motions, seen_error

# Name of the case, scene, and what else is said to the generator.
CASES = [
    ("stripes", "stripes", []),
    ("stripes, no noise", "stripes", ["--ideal"]),
    ("stripes, dark", "stripes", ["--lighting", "darkness"]),
    ("stripes at once", "stripes", ["--blind", 20, 60]),
    ("stripes after texture", "stripes_after_texture", []),
    ("blank", "blank", []),
    ("blank at once", "blank", ["--blind", 20, 60]),
    ("blank at once, no noise", "blank", ["--blind", 20, 60, "--ideal"]),
    ("blank after texture", "blank_after_texture", []),
    ("tube", "tube", []),
    ("rings", "rings", []),
    ("floor", "floor", []),
    ("floor, dark", "floor", ["--lighting", "darkness"]),
    ("blank floor", "blank_floor", []),
    ("blank floor at once", "blank_floor", ["--blind", 20, 60]),
]
QUICK_CASES = ["stripes", "blank at once"]
METHODS = ["mivo", "hybrid", "mi", "ssd"]
SEEDS = range(1, 11)
FRAMES, QUICK_FRAMES = 120, 30
AFTER_TEXTURE_FRAMES = 180  # until the picture is out of sight
FAR_M, FAR_DEG = 0.05, 3.0
HEAD = ["scene", "method", "tracking", "degraded", "lost", "initializing", "undetected gross errors",
        "within 3 sigma, worst axis", "NEES / 6", "constrained: median mm deg", "constrained: 95 % mm deg"]
TEXT = f"""
{len(SEEDS)} seeds each, `--trajectory slide`, {SMALL[1]} x {SMALL[3]}. "At once": textured until frame 20 and from frame 80 on;
"after texture": a picture leaves the view; "dark": nearly no light for 20 frames in the middle. Errors are
those of measured poses relative to the first. "Undetected gross errors": state tracking with an error of more
than {100 * FAR_M:.0f} cm or {FAR_DEG:.0f} deg. "Within 3 sigma": fraction of the frames whose error along or about an axis of the camera
is within three standard deviations, for the worst axis. "Constrained": error without its component along the
open directions."""

Judged = collections.namedtuple("Judged", "states far within nees seen")


def degenerate(bench):
    cases = [case for case in CASES if not bench.options.quick or case[0] in QUICK_CASES]
    methods = [method for method in METHODS if method in bench.methods]
    seeds = SEEDS[:1] if bench.options.quick else SEEDS
    rows, progress = [], Progress(len(cases) * len(seeds), "scenes with open directions")
    for case in cases:
        judged = {method: [] for method in methods}
        for seed in seeds:
            folder = film(bench, case, seed)
            for method in methods:
                judged[method].append(judge(bench.track(method, folder), case[1], seed))
            progress.step(f"{case[0]} {seed}")
        rows += [[case[0], method] + summary(judged[method]) for method in methods]
    progress.close()
    bench.say_table("Open directions", HEAD, rows, TEXT)


def film(bench, case, seed):
    name, scene, options = case
    frames = AFTER_TEXTURE_FRAMES if scene.endswith("after_texture") else FRAMES
    frames = QUICK_FRAMES if bench.options.quick else frames
    return bench.generate(f"{name.replace(', ', '_').replace(' ', '_')}{seed}_{frames}",
                          "--scene", scene, "--trajectory", "slide", "--frames", frames, "--seed",
                          seed, *SMALL, "--no-blur", *options)


def judge(frames, scene, seed):
    motions = open_motions(scene, seed)
    far, within, seen = 0, [], []
    for frame, pose in in_world(frames)[1:]:
        error = motion(pose, frame.truth)
        meters, radians = size(error)
        far += frame.state == "tracking" and (meters > FAR_M or np.degrees(radians) > FAR_DEG)
        sigma = np.sqrt(np.diag(covariance_of(frame.row)))
        within.append(np.abs(vector_of(error)) <= 3.0 * sigma)
        seen.append(size(seen_error(error, frame.truth, motions)))
    return Judged(collections.Counter(frame.state for frame in frames), far, within, nees(frames),
                  seen)


def summary(judged):
    """Cells of a row, over all seeds."""
    states = sum((one.states for one in judged), collections.Counter())
    counts = [str(states[name]) for name in ("tracking", "degraded", "lost", "initializing")]
    within = [axes for one in judged for axes in one.within]
    if not within:
        return counts + ["0", "", "", "", ""]
    seen = np.array([sizes for one in judged for sizes in one.seen])
    return counts + [str(sum(one.far for one in judged)),
                     f"{100.0 * np.mean(within, axis=0).min():.1f} %",
                     f"{mean([ratio for one in judged for ratio in one.nees]):.2f}",
                     in_millimeters(seen, 0.5), in_millimeters(seen, 0.95)]


def in_millimeters(sizes, share):
    return "{:.2f} {:.3f}".format(1e3 * quantile(sizes[:, 0], share),
                                  np.degrees(quantile(sizes[:, 1], share)))
