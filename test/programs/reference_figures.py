#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The figures of evaluate_trajectory from their definitions, written down a second time.

    reference_figures.py TRUTH ESTIMATE [DELTA]

Plain and slow on purpose: complex products of quaternions instead of matrices, minima over whole
lists instead of searches. With the truth at the stamps of the estimate, these are also the figures of
the published tools of the TUM RGB-D benchmark (fixed delta, no subsampling), and those of ATE, from
frame to frame and over meters are evo's: evo_ape --align [--correct_scale], evo_rpe --delta 1
--delta_unit f|m --pairs_from_reference, with --pose_relation trans_part or angle_deg.
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


def matched(truth, estimate):
    """Pairs of poses that belong together, in the order of time."""
    candidates = sorted(
        (abs(q[0] - p[0]), i, j) for i, q in enumerate(truth) for j, p in enumerate(estimate)
        if abs(q[0] - p[0]) < MAX_TIME_DIFFERENCE)
    partners = {}
    for _, i, j in candidates:
        if i not in partners.values() and j not in partners:
            partners[j] = i
    return [(truth[partners[j]], estimate[j]) for j in sorted(partners)]


def angle(q):
    return math.degrees(2 * math.atan2(numpy.linalg.norm(q[:3]), abs(q[3])))


def evo_relative_errors(pairs, ids):
    """evo's relative pose error: (Q_i^-1 Q_j)^-1 (P_i^-1 P_j)."""
    translations, angles = [], []
    for i, j in ids:
        (q_i, p_i), (q_j, p_j) = pairs[i], pairs[j]
        error = seen_from(seen_from(q_i[1:], q_j[1:]), seen_from(p_i[1:], p_j[1:]))
        translations.append(numpy.linalg.norm(error[0]))
        angles.append(angle(error[1]))
    return numpy.array(translations), numpy.array(angles)


def path_ids(pairs, delta):
    """evo's filter_pairs_by_path, consecutive pairs, from the reference."""
    ids, path = [], 0.0
    for i in range(1, len(pairs)):
        path += numpy.linalg.norm(pairs[i][0][1] - pairs[i - 1][0][1])
        if path >= delta:
            ids.append(i)
            path = 0.0
    return list(zip(ids, ids[1:]))


def alignment(pairs):
    """Horn's quaternion, the largest eigenvector of a 4x4 matrix of the correlations, and scale."""
    q = numpy.array([pair[0][1] for pair in pairs])
    p = numpy.array([pair[1][1] for pair in pairs])
    s = (p - p.mean(0)).T @ (q - q.mean(0))
    v = numpy.array([s[1, 2] - s[2, 1], s[2, 0] - s[0, 2], s[0, 1] - s[1, 0]])
    n = numpy.zeros((4, 4))
    n[:3, :3] = s + s.T - numpy.trace(s) * numpy.eye(3)
    n[:3, 3] = n[3, :3] = v
    n[3, 3] = numpy.trace(s)
    best = numpy.linalg.eigh(n)[1][:, 3]
    turned = numpy.array([rotate(best, x - p.mean(0)) for x in p])
    # Umeyama's scale: what of the variance of p the turned p explains of q.
    scale = (turned * (q - q.mean(0))).sum() / ((p - p.mean(0)) ** 2).sum()
    return best, turned + q.mean(0) - q, scale, scale * turned + q.mean(0) - q


def rmse(values):
    return math.sqrt((values ** 2).mean())


def main():
    truth, estimate = read(sys.argv[1]), read(sys.argv[2])
    delta = float(sys.argv[3]) if len(sys.argv) > 3 else 1.0
    t, r = relative_errors(truth, estimate, lambda i: nearest(estimate, estimate[i][0] + delta))
    pairs = matched(truth, estimate)
    frame_t, frame_r = evo_relative_errors(pairs, [(i - 1, i) for i in range(1, len(pairs))])
    path_t, path_r = evo_relative_errors(pairs, path_ids(pairs, 1.0))
    turn, differences, scale, scaled = alignment(pairs)
    absolute = numpy.linalg.norm(differences, axis=1)
    turns = numpy.array([angle(multiply(conjugate(q[2]), multiply(turn, p[2]))) for q, p in pairs])
    figures = {
        "frames": len(estimate),
        "coverage": (pairs[-1][1][0] - pairs[0][1][0]) / (truth[-1][0] - truth[0][0]),
        "matched": len(pairs) / len(estimate),
        "rpe_frame_translation_rmse_m": rmse(frame_t),
        "rpe_frame_rotation_rmse_deg": rmse(frame_r),
        "rpe_path_translation_percent": 100 * path_t.mean(),
        "rpe_path_rotation_deg_per_m": path_r.mean(),
        "ate_rmse_m": rmse(absolute),
        "ate_mean_m": absolute.mean(),
        "ate_median_m": numpy.median(absolute),
        "ate_max_m": absolute.max(),
        "ate_x_rmse_m": rmse(differences[:, 0]),
        "ate_y_rmse_m": rmse(differences[:, 1]),
        "ate_z_rmse_m": rmse(differences[:, 2]),
        "ate_rotation_rmse_deg": rmse(turns),
        "ate_scale": scale,
        "ate_scaled_rmse_m": rmse(numpy.linalg.norm(scaled, axis=1)),
        "ate_pairs": len(pairs),
    }
    for name, translations, angles in (("rpe", t, r), ("rpe_path", path_t, path_r)):
        figures.update({
            name + "_translation_rmse_m": rmse(translations),
            name + "_rotation_rmse_deg": rmse(angles),
            name + "_translation_median_m": numpy.median(translations),
            name + "_rotation_median_deg": numpy.median(angles),
            name + "_translation_max_m": translations.max(),
            name + "_rotation_max_deg": angles.max(),
            name + "_pairs": len(translations),
        })
    for name, value in figures.items():
        print("{}: {:.12g}".format(name, value))


main()
