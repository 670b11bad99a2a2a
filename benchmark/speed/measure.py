# SPDX-License-Identifier: BSD-3-Clause
"""What is measured, and how often."""

from measuring.methods import PEERS, TIMED
from measuring.sequences import find_recordings
from measuring.statistics import by_frame, column, quantile

SIZES = ((160, 120), (320, 240), (640, 480), (1280, 960))
FRACTIONS = (0.0125, 0.025, 0.05, 0.1, 0.2)
BINS = (4, 8, 16, 32)


class Plan:
    """How much is measured."""

    def __init__(self, quick):
        self.frames = 20 if quick else 120
        self.peer_frames = 10 if quick else 60
        self.size_frames = 10 if quick else 40
        self.sizes = SIZES[:-1] if quick else SIZES  # the last takes as long as the others together
        self.repetitions = 1 if quick else 3
        self.kernel_seconds = 0.02 if quick else 0.2


def find_sequences(runs, plan):
    """Folders by name: recordings, and a room."""
    sequences = find_recordings("rgb.txt")
    sequences["room"] = runs.film("room", "--frames", plan.frames)
    return sequences


def measure_sequence(runs, plan, folder):
    """Rows of each method and medians of each peer. The runs take turns, so that what else the
    machine does falls on all of them."""
    rows = {name: [] for name in TIMED}
    peers = {name: [] for name in PEERS}
    for _ in range(plan.repetitions):
        for name, options in TIMED.items():
            rows[name].append(runs.track(folder, plan.frames, *options))
        for name in PEERS:
            peers[name].append(runs.peer(folder, plan.peer_frames, name))
    return {"rows": {name: by_frame(repeated) for name, repeated in rows.items()},
            "peers": {name: quantile(values, 0.5) for name, values in peers.items()}}


def measure_sizes(runs, plan):
    """Median time per frame by image size: (width, method, milliseconds)."""
    result = []
    for width, height in plan.sizes:
        folder = runs.film("room_%d" % width, "--frames", plan.size_frames, "--width", width,
                           "--height", height)
        for name, options in TIMED.items():
            rows = by_frame([runs.track(folder, plan.size_frames, *options)
                             for _ in range(plan.repetitions)])
            result.append((width, name, quantile(column(rows, "cpu_ms"), 0.5)))
    return result


def measure_parameter(runs, plan, folder, name, values, options):
    """Median time per frame by the value of a parameter: (value, milliseconds)."""
    result = []
    for value in values:
        rows = by_frame([runs.track(folder, plan.size_frames, "--set", "%s=%g" % (name, value),
                                    *options) for _ in range(plan.repetitions)])
        result.append((value, quantile(column(rows, "cpu_ms"), 0.5)))
    return result
