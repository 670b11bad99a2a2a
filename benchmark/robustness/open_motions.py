# SPDX-License-Identifier: BSD-3-Clause
"""Motions that single surfaces leave open, and the error without its component along them."""

import numpy as np

from measuring.trajectories import adjoint, cross_matrix, exp_so3, vector_of

GOLDEN_RATIO = 0.618034  # as the generator turns the stripes of a floor
LEVER_M = 2.0  # a rotation counts as the motion of what is that far away
STEPS = 4  # each takes out what the one before left for want of linearity

ALONG_X, ALONG_Y, ALONG_Z, ABOUT_X, ABOUT_Y, ABOUT_Z = np.eye(6)


def open_motions(scene, seed):
    """Small motions (translation, rotation) of the world that change no image: 6 x k."""
    if scene.startswith("stripes"):
        motions = [ALONG_Z]
    elif scene.startswith("blank_floor"):
        motions = [ALONG_X, ALONG_Y, ABOUT_Z]
    elif scene.startswith("blank"):
        motions = [ALONG_Y, ALONG_Z, ABOUT_X]
    elif scene == "tube":
        motions = [ALONG_Y]
    elif scene == "rings":
        motions = [ABOUT_Y]
    else:  # a floor
        turn = np.pi * ((GOLDEN_RATIO * seed) % 1.0)
        motions = [np.cos(turn) * ALONG_X + np.sin(turn) * ALONG_Y]
    return np.array(motions).T


def seen_error(error, pose, motions):
    """Of the error of a pose (in its own axes) what the scene does not leave open: as a pose."""
    directions = adjoint(np.linalg.inv(pose)) @ motions
    weights = np.array([1.0] * 3 + [LEVER_M] * 3)[:, None]
    for _ in range(STEPS):
        coefficients = np.linalg.lstsq(weights * directions, weights[:, 0] * vector_of(error),
                                       rcond=None)[0]
        error = small_motion(-directions @ coefficients) @ error
    return error


def small_motion(twist):
    """The pose that a motion of constant twist (translation, rotation) leads to."""
    pose = np.eye(4)
    pose[:3, :3] = exp_so3(twist[3:])
    pose[:3, 3] = left_jacobian(twist[3:]) @ twist[:3]
    return pose


def left_jacobian(vector):
    """Mean of the rotations on the way to exp_so3(vector)."""
    angle = np.linalg.norm(vector)
    if angle < 1e-9:
        return np.eye(3) + 0.5 * cross_matrix(vector)
    axis = cross_matrix(vector / angle)
    return np.eye(3) + (1.0 - np.cos(angle)) / angle * axis + \
        (1.0 - np.sin(angle) / angle) * axis @ axis
