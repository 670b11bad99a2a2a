# SPDX-License-Identifier: BSD-3-Clause
"""Frames reported as lost although motion and light were ordinary."""

import os

import judging
from bench import FILMED_LIGHT
from measuring import sequences
from measuring.progress import Progress

STARTS = range(0, 25)
LEAST_FRAMES = 15  # of a run
HEAD = ["sequences", "runs", "frames", "lost", "false losses", "share", "undetected errors",
        "runs with such"]
TEXT = f"""
A loss is false when the frames before and after it are measured, their poses differ by less than
{judging.ORDINARY_STEPS:.0f} times the median step (of up to {judging.NEIGHBORS} neighbors on each side) per frame in between, and the lost image has
a mean of at least {judging.LIT_MEAN:.0f} gray levels and a deviation of at least {judging.LIT_DEVIATION:.0f}. Recordings are run from each of {len(STARTS)}
starting frames. An empty cell means that there is no ground truth."""


def count(bench):
    rows = [filmed(bench)]
    for name, folder in recordings(bench).items():
        rows.append(recorded(bench, name, folder))
    bench.say_table("False losses", HEAD, rows + [total(rows)], TEXT)


def filmed(bench):
    folders = [bench.filmed(scene, seed, path, light) for scene, seed in bench.scenes
               for path in bench.paths
               for light in (FILMED_LIGHT[:1] if bench.options.quick else FILMED_LIGHT)]
    return row_of(bench, "filmed, all lights", [(bench.track("mivo", folder), folder) for folder in folders])


def recordings(bench):
    """All of them: no truth is needed."""
    return {} if bench.options.quick else sequences.find_recordings("rgb.txt")


def recorded(bench, name, folder):
    with open(os.path.join(folder, "rgb.txt"), encoding="utf-8") as file:
        length = sum(1 for line in file if line.strip() and not line.startswith("#"))
    starts = [start for start in STARTS if length - start >= LEAST_FRAMES]
    progress = Progress(len(starts), f"starts of {name}")
    runs = []
    for start in starts:
        runs.append((bench.track("mivo", folder, "--start", start), folder))
        progress.step(str(start))
    progress.close()
    return row_of(bench, name, runs)


def row_of(bench, name, runs):
    frames = sum(len(run) for run, _ in runs)
    lost = sum(frame.state == "lost" for run, _ in runs for frame in run)
    false = sum(len(judging.false_losses(run, judging.color_by_stamp(folder)))
                for run, folder in runs)
    return [name, len(runs), frames, lost, false, share(false, frames)] + wrong(bench, runs)


def wrong(bench, runs):
    """How many frames are, and in how many runs."""
    if not any(frame.truth is not None for run, _ in runs for frame in run):
        return ["", ""]
    counts = [len(judging.wrong_motions(run, bench.is_recorded(folder))) for run, folder in runs]
    return [sum(counts), sum(number > 0 for number in counts)]


def share(false, frames):
    return f"{100.0 * false / frames:.3f} %"


def total(rows):
    sums = [sum(row[k] for row in rows) for k in range(1, 5)]
    return ["all"] + sums + [share(sums[3], sums[1])] + [
        sum(row[k] for row in rows if row[k] != "") for k in (6, 7)]
