# SPDX-License-Identifier: BSD-3-Clause
"""Wrong frames reported as tracking, good frames reported as lost, recovery."""

import os

import numpy as np

import events
from judging import far_wrong
from measuring.tracks import measured, read_frames
from measuring.trajectories import difference

HEAD = ["sequence", "event", "tracking", "degraded", "lost", "wrong but tracking",
        "undetected errors", "frames until recovered"]


def loss(bench):
    rows = []
    places = [bench.filmed(scene, seed, "figure_of_eight", "constant")
              for scene, seed in bench.scenes]
    middle = bench.frames // 2
    missing = 3 * bench.frames // 10  # more than a second is left of a short sequence, too
    for i, place in enumerate(places):
        name = os.path.basename(place)
        other = places[(i + 1) % len(places)] if len(places) > 1 else bench.filmed(
            "office", 2, "rotation", "constant")
        for kind, folder in [
                ("covered 2 s", events.covered(place + "_covered", place, middle, 60)),
                ("teleport", events.teleported(place + "_teleport", place, middle - missing // 2,
                                               missing)),
                ("joined", events.joined(place + "_joined", place, other, middle)),
                ("blurred", events.blurred(place + "_blurred", place, middle, 10))]:
            figures = bench.run("mivo", folder)
            frames = read_frames(figures["base"], folder)
            rows.append([name, kind, figures["tracked"], figures["degraded"], figures["lost"],
                         str(len(far_wrong(frames))), bench.wrong(figures, folder),
                         recovery(frames, middle + 60) if kind == "covered 2 s" else ""])
    bench.say_table("Loss", HEAD, rows)


def recovery(frames, first):
    """Frames from `first` on until the state is good and the pose within 2 cm, 1 deg again."""
    start = frames[0]
    for number, frame in enumerate(frames[first:], 1):
        if not measured([frame]):
            continue
        meters, radians = difference(start.pose, frame.pose, start.truth, frame.truth)
        if meters < 0.02 and np.degrees(radians) < 1.0:
            return str(number)
    return "never"
