# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories as mivo's programs write them, errors between poses, and their covariances."""

import numpy as np


def matrix(position, quaternion):
    """4x4 pose of a position (m) and a quaternion (x, y, z, w)."""
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    pose = np.eye(4)
    pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    pose[:3, 3] = position
    return pose


def read_trajectory(path):
    """Stamps (n) and poses (n, 4, 4) of a trajectory file."""
    with open(path, encoding="utf-8") as file:
        rows = np.array([line.split() for line in file if line.strip() and line[0] != "#"], float)
    rows = rows.reshape(-1, 8)  # of a run in which nothing was tracked there is none
    return rows[:, 0], np.array([matrix(row[1:4], row[4:8]) for row in rows]).reshape(-1, 4, 4)


def poses_at(stamps, truth_stamps, truth_poses, tolerance=0.02):
    """The true pose nearest to each stamp, and which of them are within the tolerance (s)."""
    right = np.clip(np.searchsorted(truth_stamps, stamps), 1, len(truth_stamps) - 1)
    left = right - 1
    nearer_left = np.abs(truth_stamps[left] - stamps) < np.abs(truth_stamps[right] - stamps)
    index = np.where(nearer_left, left, right)
    return truth_poses[index], np.abs(truth_stamps[index] - stamps) <= tolerance


def interpolated(stamps, truth_stamps, truth_poses, longest=0.1):
    """The true pose at each stamp, between its neighbors; None where they are farther apart (s)
    than `longest` or there is none."""
    poses = []
    for stamp in stamps:
        right = int(np.searchsorted(truth_stamps, stamp - 1e-6))
        if right < len(truth_stamps) and abs(truth_stamps[right] - stamp) < 2e-6:
            poses.append(truth_poses[right])
        elif 0 < right < len(truth_stamps) and \
                truth_stamps[right] - truth_stamps[right - 1] <= longest:
            share = (stamp - truth_stamps[right - 1]) / (truth_stamps[right] -
                                                         truth_stamps[right - 1])
            poses.append(between(truth_poses[right - 1], truth_poses[right], share))
        else:
            poses.append(None)
    return poses


def between(first, second, share):
    """The pose at a share of the straight way and of the turn from one to the other."""
    pose = np.eye(4)
    pose[:3, 3] = first[:3, 3] + share * (second[:3, 3] - first[:3, 3])
    pose[:3, :3] = first[:3, :3] @ exp_so3(share * log_so3(first[:3, :3].T @ second[:3, :3]))
    return pose


def exp_so3(vector):
    """Rotation matrix of a rotation vector."""
    angle = np.linalg.norm(vector)
    if angle < 1e-12:
        return np.eye(3) + cross_matrix(vector)
    axis = cross_matrix(vector / angle)
    return np.eye(3) + np.sin(angle) * axis + (1.0 - np.cos(angle)) * axis @ axis


def cross_matrix(vector):
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def adjoint(pose):
    """Takes small motions (translation, rotation) from the axes of a frame to those in which `pose`
    is given."""
    matrix6 = np.zeros((6, 6))
    matrix6[:3, :3] = matrix6[3:, 3:] = pose[:3, :3]
    matrix6[:3, 3:] = cross_matrix(pose[:3, 3]) @ pose[:3, :3]
    return matrix6


def vector_of(pose):
    """Translation and rotation vector of a small motion."""
    return np.concatenate([pose[:3, 3], log_so3(pose[:3, :3])])


def size(pose):
    """Length (m) and angle (rad) of a pose."""
    cosine = np.clip(0.5 * (np.trace(pose[:3, :3]) - 1.0), -1.0, 1.0)
    sine = 0.5 * np.linalg.norm([pose[2, 1] - pose[1, 2], pose[0, 2] - pose[2, 0],
                                 pose[1, 0] - pose[0, 1]])
    return np.linalg.norm(pose[:3, 3]), np.arctan2(sine, cosine)


def log_so3(rotation):
    """Rotation vector of a rotation matrix."""
    axis = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0],
                     rotation[1, 0] - rotation[0, 1]])
    sine = 0.5 * np.linalg.norm(axis)
    angle = np.arctan2(sine, np.clip(0.5 * (np.trace(rotation) - 1.0), -1.0, 1.0))
    return 0.5 * axis if sine < 1e-12 else axis * (0.5 * angle / sine)


def covariance_of(row, name="covariance"):
    """6x6 covariance of a row of statistics: `covariance` of the pose, `alignment_covariance` of the
    alignment with the keyframe alone."""
    covariance = np.empty((6, 6))
    for i in range(6):
        for j in range(i, 6):
            covariance[i, j] = covariance[j, i] = row[f"{name}_{i}{j}"]
    return covariance


def normalized_error(estimate, truth, covariance):
    """Squared error of a pose over its covariance (NEES); 6 in the mean for an honest one."""
    vector = vector_of(np.linalg.inv(estimate) @ truth)
    return vector @ np.linalg.solve(covariance, vector)


def difference(estimate_a, estimate_b, truth_a, truth_b):
    """Error of the motion from a to b: length (m), angle (rad)."""
    estimated = np.linalg.inv(estimate_a) @ estimate_b
    true = np.linalg.inv(truth_a) @ truth_b
    return size(np.linalg.inv(true) @ estimated)
