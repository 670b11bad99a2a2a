# SPDX-License-Identifier: BSD-3-Clause
"""What a run said of each frame beside its pose and the true one."""

import collections
import os

import numpy as np

from measuring.statistics import read_rows
from measuring.trajectories import interpolated, read_trajectory

MEASURED = ("tracking", "degraded")

# `row` has all statistics; pose and truth (4x4) are None where there is none. Poses and statistics
# belong together by stamp: an initializing frame has statistics alone.
Frame = collections.namedtuple("Frame", "stamp state segment row pose truth")


def read_frames(base, folder):
    """Frames of a run (its files without their endings) over a sequence, in their order."""
    rows = read_rows(base + ".csv")
    poses = {in_microseconds(stamp): pose for stamp, pose in zip(*read_trajectory(base + ".txt"))}
    truth_path = os.path.join(folder, "groundtruth.txt")
    truths = [None] * len(rows)
    if os.path.exists(truth_path):
        truths = interpolated([row["stamp"] for row in rows], *read_trajectory(truth_path))
    return [Frame(row["stamp"], row["state"], int(row["segment"]), row,
                  pose_of(row, poses), truth) for row, truth in zip(rows, truths)]


def in_microseconds(stamp):
    return int(round(stamp * 1e6))


def pose_of(row, poses):
    """Of an initializing frame the pose that may be written means nothing."""
    return None if row["state"] == "initializing" else poses.get(in_microseconds(row["stamp"]))


def measured(frames):
    return [frame for frame in frames if frame.state in MEASURED and frame.pose is not None]


def motion(first, second):
    """From one pose to another, in the axes of the first."""
    return np.linalg.inv(first) @ second
