# SPDX-License-Identifier: BSD-3-Clause
"""Periods without frames while the camera moves: how far is a pose extrapolated?"""

import numpy as np

import events
from bench import SMALL
from measuring.tracks import MEASURED

GAPS_S = [0.5, 2.0, 10.0, 60.0, 600.0]
KINDS = ["elsewhere", "covered", "goes on"]
FRAMES, QUICK_FRAMES = 60, 30
VELOCITY_SECONDS = 0.5  # of motion may be added to the last good pose
RATE = 30.0
HEAD = ["gap s", "then", "m/s before", "farthest pose m", "allowed m", "tracking", "degraded", "lost"]
TEXT = f"""
A camera moves along a wall and frames are missing for a period. Then follow another place, a covered lens, or
the continuation of the motion. "Farthest pose": largest distance from the last measured pose to a pose that is
not measured or starts a new segment; allowed are {VELOCITY_SECONDS} s at the largest of the last five speeds plus 1 mm.
States are those of the frames after the gap."""


def gaps(bench):
    frames = QUICK_FRAMES if bench.options.quick else FRAMES
    here = film(bench, "wall", 1, frames)
    there = film(bench, "office", 2, frames)
    rows = []
    for seconds in GAPS_S[-2:-1] if bench.options.quick else GAPS_S:
        for kind in KINDS:
            folder = events.after_gap(f"{here}_gap{seconds:g}_{kind.replace(' ', '_')}", here, there,
                                      kind, seconds)
            rows.append([f"{seconds:g}", kind] + row_of(bench.track("mivo", folder), frames // 2))
    bench.say_table("Gaps in time", HEAD, rows, TEXT)


def film(bench, scene, seed, frames):
    return bench.generate(f"{scene}{seed}_translation_gap_{frames}", "--scene", scene,
                          "--trajectory", "translation", "--frames", frames, "--seed", seed, *SMALL)


def row_of(frames, first):
    """Cells of a row; `first` is the number of the first frame after the gap."""
    start = frames[0].stamp + (first - 0.5) / RATE
    before = [frame for frame in frames if frame.stamp < start and frame.state in MEASURED]
    after = [frame for frame in frames if frame.stamp > start]
    speed = max(distance(a, b) / (b.stamp - a.stamp) for a, b in zip(before[-6:], before[-5:]))
    states = [frame.state for frame in after]
    return [f"{speed:.2f}", f"{farthest(before[-1], after):.3f}",
            f"{VELOCITY_SECONDS * speed + 0.001:.3f}"] + [
                str(states.count(name)) for name in ("tracking", "degraded", "lost")]


def farthest(good, frames):
    """The farthest way from the last good pose to one that is a guess, m."""
    way, segment = 0.0, good.segment
    for frame in frames:
        if frame.pose is None:
            continue
        if frame.state in MEASURED and frame.segment == segment:
            good = frame
        else:
            way = max(way, distance(good, frame))
            segment = frame.segment
    return way


def distance(first, second):
    return np.linalg.norm(first.pose[:3, 3] - second.pose[:3, 3])
