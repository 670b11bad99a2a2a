# SPDX-License-Identifier: BSD-3-Clause
"""Whether the states and covariances that a run reports are true."""

import os

import numpy as np
from PIL import Image

from measuring.statistics import quantile
from measuring.tracks import measured, motion
from measuring.trajectories import (
    adjoint, covariance_of, difference, normalized_error, size, vector_of)

# A pose against its keyframe.
FAR_WRONG_M, FAR_WRONG_DEG = 0.10, 5.0
# A motion from the frame before: beyond this and a share of the motion, and beyond what is claimed.
WRONG_M, WRONG_DEG, WRONG_SHARE, WRONG_SIGMA = 0.003, 0.1, 0.02, 5.0
# The truth of a recording errs, too: there a motion must stand out of the run's own errors.
STANDS_OUT = 5.0
# Ordinary motion between two frames, in median steps of the neighboring frames.
ORDINARY_STEPS, NEIGHBORS = 3.0, 10
LEAST_STEP_M, LEAST_STEP_DEG = 0.001, 0.05
LIT_MEAN, LIT_DEVIATION = 30.0, 10.0  # gray levels

WRONG_TEXT = f"""
"Undetected errors": frames with state tracking whose motion since the previous measured frame of the segment is wrong
by more than {1e3 * WRONG_M:.0f} mm and {100 * WRONG_SHARE:.0f} % of its length, or by more than {WRONG_DEG} deg and {100 * WRONG_SHARE:.0f} % of its angle, and by more than {WRONG_SIGMA:.0f} sigma
of the sum of both frames' `alignment_covariance`. A frame that returns from a wrong pose counts as well. For
recordings, whose ground truth has errors, the error must also exceed {STANDS_OUT:.0f} times the run's median."""


def far_wrong(frames):
    """Frames with state tracking and a grossly wrong pose relative to the keyframe."""
    keyframe_of, made, wrong = {}, 0, []
    for frame in frames:
        keyframe = keyframe_of.get(int(frame.row["keyframe"]))
        if frame.state == "tracking" and keyframe and has_both(frame) and has_both(keyframe):
            meters, radians = difference(keyframe.pose, frame.pose, keyframe.truth, frame.truth)
            if meters > FAR_WRONG_M or np.degrees(radians) > FAR_WRONG_DEG:
                wrong.append(frame)
        if frame.row["new_keyframe"] == 1.0:
            made += 1
            keyframe_of[made] = frame
    return wrong


def has_both(frame):
    return frame.pose is not None and frame.truth is not None


def motion_pairs(frames):
    """Each measured frame with the one before it, of one segment and of known truth."""
    known = [frame for frame in measured(frames) if frame.truth is not None]
    return [(a, b) for a, b in zip(known, known[1:]) if a.segment == b.segment]


def motion_error(before, now):
    """Error of the estimated motion, in the axes of `now`."""
    return motion(motion(before.pose, now.pose), motion(before.truth, now.truth))


def motion_covariance(before, now):
    """Covariance of that error: both frames are aligned with a keyframe independently."""
    back = adjoint(motion(now.pose, before.pose))
    return covariance_of(now.row, "alignment_covariance") + \
        back @ covariance_of(before.row, "alignment_covariance") @ back.T


def wrong_motions(frames, is_recording=False):
    """Frames with state tracking whose motion since the previous one is wrong."""
    pairs = motion_pairs(frames)
    errors = [motion_error(*pair) for pair in pairs]
    sizes = np.array([size(error) for error in errors]).reshape(-1, 2)
    usual = STANDS_OUT * np.median(sizes, axis=0) if is_recording and pairs else (0.0, 0.0)
    return [now for (before, now), error in zip(pairs, errors)
            if now.state == "tracking" and is_wrong(before, now, error, usual)]


def is_wrong(before, now, error, usual):
    covariance = motion_covariance(before, now)
    vector = vector_of(error)
    least = (WRONG_M, np.radians(WRONG_DEG))
    for part, length, moved, bound, ordinary in zip(
            (slice(0, 3), slice(3, 6)), size(error), size(motion(before.truth, now.truth)), least,
            usual):
        sigmas = np.sqrt(vector[part] @ np.linalg.solve(covariance[part, part], vector[part]))
        if length > max(bound + WRONG_SHARE * moved, ordinary) and sigmas > WRONG_SIGMA:
            return True
    return False


def false_losses(frames, color_of):
    """Frames reported as lost between two measured ones whose poses differ by an ordinary motion,
    and whose image is not dark. color_of(stamp) is the path of the color image."""
    good = [i for i, frame in enumerate(frames)
            if frame.state in ("tracking", "degraded") and frame.pose is not None]
    steps = {a: size(motion(frames[a].pose, frames[b].pose))
             for a, b in zip(good, good[1:]) if b == a + 1}
    lost = []
    for a, b in zip(good, good[1:]):
        between = [frame for frame in frames[a + 1:b] if frame.state == "lost"]
        if not between or frames[a].segment != frames[b].segment:
            continue
        if is_ordinary(size(motion(frames[a].pose, frames[b].pose)), b - a, usual_step(steps, a, b)):
            lost += [frame for frame in between if shows_something(color_of(frame.stamp))]
    return lost


def usual_step(steps, first, last):
    """Median length (m) and angle (rad) of the measured steps on both sides of a gap."""
    near = [steps[i] for i in range(first - NEIGHBORS, last + NEIGHBORS) if i in steps]
    if not near:
        return None
    return tuple(quantile([step[k] for step in near], 0.5) for k in range(2))


def is_ordinary(moved, frames, usual):
    if usual is None:
        return False
    least = (LEAST_STEP_M, np.radians(LEAST_STEP_DEG))
    return all(way <= ORDINARY_STEPS * frames * max(step, bound)
               for way, step, bound in zip(moved, usual, least))


def shows_something(path):
    gray = np.asarray(Image.open(path).convert("L"), np.float64)
    return gray.mean() >= LIT_MEAN and gray.std() >= LIT_DEVIATION


def color_by_stamp(folder):
    """A function from a stamp to the path of the color image."""
    with open(os.path.join(folder, "rgb.txt"), encoding="utf-8") as file:
        rows = [line.split() for line in file if line.strip() and not line.startswith("#")]
    paths = {round(float(row[0]), 6): os.path.join(folder, row[1]) for row in rows}
    return lambda stamp: paths[round(stamp, 6)]


def in_world(frames):
    """Poses of the measured frames in the world of the truth, the first of them being true."""
    known = [frame for frame in measured(frames) if frame.truth is not None]
    if not known:
        return []
    world = known[0].truth @ np.linalg.inv(known[0].pose)
    return [(frame, world @ frame.pose) for frame in known]


def nees(frames):
    """Squared error of each pose but the first over its claimed covariance, by the six numbers."""
    return [normalized_error(pose, frame.truth, covariance_of(frame.row)) / 6.0
            for frame, pose in in_world(frames)[1:]]
