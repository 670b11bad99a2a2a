# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of even colors and few edges, at 0.3 to 3 degrees per frame."""

import collections

from bench import SMALL
from judging import WRONG_M, false_losses, color_by_stamp, motion_error, motion_pairs, wrong_motions
from measuring.progress import Progress
from measuring.trajectories import size

SCENES = ["hallway", "ceiling", "panels", "hall", "whiteboard"]
QUICK_SCENES = ["hallway"]
PATHS = ["rotation", "figure_of_eight"]
SEEDS = range(1, 21)
FRAMES, QUICK_FRAMES = 60, 15
SLOWEST, FASTEST = 0.3, 2.5  # paces; a rotation at pace 1 turns by 0.67 to 1.33 deg a frame
GOLDEN_RATIO = 0.618034
HEAD = ["scene", "method", "frames", "undetected errors", "lost", "false losses", "degraded",
        "degraded though correct"]
TEXT = f"""
{len(SEEDS)} seeds each, {FRAMES} frames of {SMALL[1]} x {SMALL[3]}; rotation and figure of eight alternate, at {SLOWEST} to {FASTEST}
times their speed: 0.2 to 3.3 degrees per frame. "Degraded though correct": the motion since the previous
frame is correct within {1e3 * WRONG_M:.0f} mm."""


def sparse(bench):
    scenes = QUICK_SCENES if bench.options.quick else SCENES
    seeds = SEEDS[:1] if bench.options.quick else SEEDS
    methods = bench.trackers()
    rows, progress = [], Progress(len(scenes) * len(seeds), "sparse scenes")
    for scene in scenes:
        sums = {method: dict.fromkeys(HEAD[2:], 0) for method in methods}
        for seed in seeds:
            folder = film(bench, scene, seed)
            for method in methods:
                for name, number in count(bench.track(method, folder), folder).items():
                    sums[method][name] += number
            progress.step(f"{scene} {seed}")
        rows += [[scene, method] + [str(sums[method][name]) for name in HEAD[2:]]
                 for method in methods]
    progress.close()
    bench.say_table("Sparse scenes", HEAD, rows, TEXT)


def pace(seed):
    """Spread evenly in logarithm over the seeds."""
    return SLOWEST * (FASTEST / SLOWEST)**((GOLDEN_RATIO * seed) % 1.0)


def film(bench, scene, seed):
    frames = QUICK_FRAMES if bench.options.quick else FRAMES
    return bench.generate(f"{scene}{seed}_{frames}", "--scene", scene, "--trajectory",
                          PATHS[seed % 2], "--pace", f"{pace(seed):.3f}", "--frames", frames,
                          "--seed", seed, *SMALL)


def count(frames, folder):
    states = collections.Counter(frame.state for frame in frames)
    right = [now for before, now in motion_pairs(frames)
             if now.state == "degraded" and size(motion_error(before, now))[0] < WRONG_M]
    return {"frames": len(frames), "undetected errors": len(wrong_motions(frames)),
            "lost": states["lost"],
            "false losses": len(false_losses(frames, color_by_stamp(folder))),
            "degraded": states["degraded"], "degraded though correct": len(right)}
