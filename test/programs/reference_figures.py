#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The figures of evaluate_trajectory from their definitions, written down a second time.

    reference_figures.py TRUTH ESTIMATE [DELTA]

Plain and slow on purpose: complex products of quaternions instead of matrices, minima over whole
lists instead of searches. With the truth at the stamps of the estimate, these are also the figures of
the published tools of the TUM RGB-D benchmark (fixed delta, no subsampling).
"""
import math
import sys

import numpy

MAX_TIME_DIFFERENCE = 0.02


def read(path):
    poses = {}
    for line in open(path):
        if line.strip() and not line.startswith("#"):
            numbers = [float(word) for word in line.split()]
            q = numpy.array(numbers[4:8])
            poses[numbers[0]] = (numpy.array(numbers[1:4]), q / numpy.linalg.norm(q))
    return [(stamp,) + poses[stamp] for stamp in sorted(poses)]


def multiply(a, b):
    vector = a[3] * b[:3] + b[3] * a[:3] + numpy.cross(a[:3], b[:3])
    return numpy.append(vector, a[3] * b[3] - a[:3].dot(b[:3]))


def conjugate(q):
    return q * numpy.array([-1, -1, -1, 1])


def rotate(q, v):
    return multiply(multiply(q, numpy.append(v, 0)), conjugate(q))[:3]


def seen_from(a, b):
    """Pose b in the axes of pose a."""
    return rotate(conjugate(a[1]), b[0] - a[0]), multiply(conjugate(a[1]), b[1])


def nearest(poses, stamp):
    return min(range(len(poses)), key=lambda i: abs(poses[i][0] - stamp))


def relative_errors(truth, estimate, partner):
    translations, angles = [], []
    for i, pose in enumerate(estimate):
        j = partner(i)
        if j >= len(estimate) - 1:
            continue
        q_i, q_j = (truth[nearest(truth, estimate[k][0])] for k in (i, j))
        if max(abs(q_i[0] - pose[0]), abs(q_j[0] - estimate[j][0])) > MAX_TIME_DIFFERENCE:
            continue
        motion = seen_from(estimate[j][1:], pose[1:])
        true_motion = seen_from(q_j[1:], q_i[1:])
        t, q = seen_from(motion, true_motion)
        translations.append(numpy.linalg.norm(t))
        angles.append(math.degrees(2 * math.atan2(numpy.linalg.norm(q[:3]), abs(q[3]))))
    return numpy.array(translations), numpy.array(angles)


def absolute_errors(truth, estimate):
    candidates = sorted(
        (abs(q[0] - p[0]), i, j) for i, q in enumerate(truth) for j, p in enumerate(estimate)
        if abs(q[0] - p[0]) < MAX_TIME_DIFFERENCE)
    partners = {}
    for _, i, j in candidates:
        if i not in partners.values() and j not in partners:
            partners[j] = i
    q = numpy.array([truth[partners[j]][1] for j in sorted(partners)])
    p = numpy.array([estimate[j][1] for j in sorted(partners)])
    # Horn's quaternion: the largest eigenvector of a 4x4 matrix of the correlations.
    s = (p - p.mean(0)).T @ (q - q.mean(0))
    v = numpy.array([s[1, 2] - s[2, 1], s[2, 0] - s[0, 2], s[0, 1] - s[1, 0]])
    n = numpy.zeros((4, 4))
    n[:3, :3] = s + s.T - numpy.trace(s) * numpy.eye(3)
    n[:3, 3] = n[3, :3] = v
    n[3, 3] = numpy.trace(s)
    best = numpy.linalg.eigh(n)[1][:, 3]
    moved = numpy.array([rotate(best, x - p.mean(0)) for x in p]) + q.mean(0)
    return numpy.linalg.norm(moved - q, axis=1)


def rmse(values):
    return math.sqrt((values ** 2).mean())


def main():
    truth, estimate = read(sys.argv[1]), read(sys.argv[2])
    delta = float(sys.argv[3]) if len(sys.argv) > 3 else 1.0
    t, r = relative_errors(truth, estimate, lambda i: nearest(estimate, estimate[i][0] + delta))
    frame_t, frame_r = relative_errors(truth, estimate, lambda i: i + 1)
    absolute = absolute_errors(truth, estimate)
    figures = {
        "frames": len(estimate),
        "coverage": (estimate[-1][0] - estimate[0][0]) / (truth[-1][0] - truth[0][0]),
        "rpe_translation_rmse_m": rmse(t),
        "rpe_rotation_rmse_deg": rmse(r),
        "rpe_translation_median_m": numpy.median(t),
        "rpe_rotation_median_deg": numpy.median(r),
        "rpe_translation_max_m": t.max(),
        "rpe_rotation_max_deg": r.max(),
        "rpe_pairs": len(t),
        "rpe_frame_translation_rmse_m": rmse(frame_t),
        "rpe_frame_rotation_rmse_deg": rmse(frame_r),
        "ate_rmse_m": rmse(absolute),
        "ate_max_m": absolute.max(),
        "ate_pairs": len(absolute),
    }
    for name, value in figures.items():
        print("{}: {:.12g}".format(name, value))


main()
