# SPDX-License-Identifier: BSD-3-Clause
"""20 nearly dark or black frames, with depth and without."""

import os

import numpy as np

import events
from bench import cell
from judging import far_wrong
from measuring.progress import Progress
from measuring.tracks import read_frames
from measuring.trajectories import difference

NEAR_DARK = ["darkness", "black"]
DARK_FRAMES = 20


def darkness(bench):
    tasks = [(f"{scene} {path}", kind, True,
              lambda s=scene, e=seed, p=path, k=kind: bench.filmed(s, e, p, k))
             for scene, seed in bench.scenes for path in bench.paths for kind in NEAR_DARK]
    tasks += [(os.path.basename(recording), kind, False,
               lambda r=recording, k=kind: bench.relit(r, k))
              for recording in bench.recordings() for kind in NEAR_DARK]
    rows, progress = [], Progress(len(tasks), "sequences of darkness")
    for name, kind, is_filmed, folder_of in tasks:
        folder = folder_of()
        results = {method: bench.run(method, folder) for method in bench.methods}
        rows.append([name, kind] + [cell(results[method]) for method in bench.methods] +
                    [bench.wrong(results["mivo"], folder) if "mivo" in results else "",
                     after_darkness(bench, folder) if is_filmed else ""])
        progress.step(f"{name} {kind}")
    progress.close()
    bench.say_table("Darkness: RPE over 1 s, m deg",
                    ["sequence", "dark"] + bench.methods +
                    ["mivo: undetected errors", "without depth: 5 frames later"], rows)


def after_darkness(bench, folder):
    """The same without depth in the dark: pose error 5 frames after the light has returned."""
    first = (bench.frames - DARK_FRAMES) // 2
    bare = events.without_depth(folder + "_without_depth", folder, first, DARK_FRAMES)
    frames = read_frames(bench.run("mivo", bare)["base"], bare)
    states = {frame.state for frame in frames[first + 2:first + DARK_FRAMES - 2]}
    start, later = frames[0], frames[first + DARK_FRAMES + 5]
    meters, radians = difference(start.pose, later.pose, start.truth, later.truth)
    return (f"{meters:.4f} {np.degrees(radians):.3f}, {'/'.join(sorted(states))}, "
            f"{len(far_wrong(frames))} wrong")
