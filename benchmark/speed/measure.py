# SPDX-License-Identifier: BSD-3-Clause
"""What is measured, and how often."""

import os

PAPER = ("--set", "photometric_model=none", "--set", "geometric_term=false", "--set",
         "rolling_shutter_estimation=false")
DEFAULT = ()
LEVELS = range(5)
PEERS = {"rgbd": "RgbdOdometry", "icp": "ICPOdometry", "rgbd_icp": "RgbdICPOdometry"}
METHODS = {"ssd": ("--method", "ssd") + PAPER, "mi": ("--method", "mi") + PAPER,
           "hybrid": ("--method", "hybrid") + PAPER, "default": DEFAULT}
SIZES = ((160, 120), (320, 240), (640, 480), (1280, 960))
FRACTIONS = (0.0125, 0.025, 0.05, 0.1, 0.2)
BINS = (4, 8, 16, 32)


class Plan:
    """How much is measured."""

    def __init__(self, quick):
        self.frames = 20 if quick else 120
        self.peer_frames = 10 if quick else 60
        self.size_frames = 10 if quick else 40
        self.repetitions = 1 if quick else 3
        self.kernel_seconds = 0.02 if quick else 0.2


def column(rows, name):
    return [row[name] for row in rows]


def mean(values):
    return sum(values) / len(values)


def deviation(values):
    middle = mean(values)
    return (sum((value - middle) ** 2 for value in values) / max(1, len(values) - 1)) ** 0.5


def quantile(values, share):
    """Interpolated between neighbours."""
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    low = int(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def find_sequences(programs, plan):
    """Folders by name: recordings, and a room."""
    sequences = {}
    root = os.environ.get("MIVO_DATA", "")
    if root:
        for name in sorted(os.listdir(root)):
            if os.path.exists(os.path.join(root, name, "rgb.txt")):
                sequences[name] = os.path.join(root, name)
    sequences["room"] = programs.film("room", "--frames", str(plan.frames))
    return sequences


def measure_sequence(programs, plan, folder):
    """Rows of each method and medians of each peer. The runs take turns, so that what else the
    machine does falls on all of them."""
    rows = {name: [] for name in METHODS}
    peers = {name: [] for name in PEERS}
    for _ in range(plan.repetitions):
        for name, options in METHODS.items():
            rows[name].append(programs.track(folder, plan.frames, *options))
        for name in PEERS:
            peers[name].append(programs.peer(folder, plan.peer_frames, name))
    return {"rows": {name: by_frame(runs) for name, runs in rows.items()},
            "peers": {name: quantile(values, 0.5) for name, values in peers.items()}}


def by_frame(runs):
    """Runs of the same frames: for each number the median over the runs."""
    merged = []
    for rows in zip(*runs):
        row = dict(rows[0])
        for name, value in rows[0].items():
            if isinstance(value, float):
                row[name] = quantile([other[name] for other in rows], 0.5)
        merged.append(row)
    return merged


def measure_sizes(programs, plan):
    """Median time per frame by image size: (width, method, milliseconds)."""
    result = []
    for width, height in SIZES:
        folder = programs.film("room_%d" % width, "--frames", str(plan.size_frames), "--width",
                               str(width), "--height", str(height))
        for name, options in METHODS.items():
            runs = [programs.track(folder, plan.size_frames, *options)
                    for _ in range(plan.repetitions)]
            result.append((width, name, quantile(column(by_frame(runs), "cpu_ms"), 0.5)))
    return result


def measure_parameter(programs, plan, folder, name, values, options):
    """Median time per frame by the value of a parameter: (value, milliseconds)."""
    result = []
    for value in values:
        runs = [programs.track(folder, plan.size_frames, "--set", "%s=%g" % (name, value), *options)
                for _ in range(plan.repetitions)]
        result.append((value, quantile(column(by_frame(runs), "cpu_ms"), 0.5)))
    return result
