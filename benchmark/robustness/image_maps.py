# SPDX-License-Identifier: BSD-3-Clause
"""What else than intensities could be compared, as maps of images that are made beforehand.

A map takes a gray image and the first one of its sequence, and gives a gray image: 8 bits each.
"""

import os
import shutil

import cv2
import numpy as np

from measuring import keys
from measuring.sequences import make_once

LOCAL_SIGMA = 5.0  # pixels; as wide as the window below
WINDOW = (17, 17)  # pixels
CONTRAST_SHARE = 0.1  # constant of normalization as a share of the frame's own contrast
MIDDLE, GRAY_LEVELS = 128.0, 55.0  # of a normalized image, as the tracker scales its own
GRADIENT_GAIN = 4.0  # gray levels per gray level per pixel: weak gradients survive the rounding
RANK_SIGMA = 1.0  # pixels
RANK_STEP = 28.0  # gray levels per neighbor
DARKER = 1e-3  # gray levels; the rounding of the blur is no difference


def equalized(gray, _):
    """As many pixels of each intensity. What a lamp does to all pixels alike, in whatever curve,
    drops out."""
    return cv2.equalizeHist(gray)


def gain_and_bias(gray, first):
    """The mean and the deviation of the first frame. An exposure drops out."""
    gain = first.std() / max(gray.std(), 1e-6)
    return to_bytes((gray - gray.mean()) * gain + first.mean())


def local_mean_removed(gray, _):
    """Difference to the surroundings. An offset that varies slowly drops out, a gain does not."""
    values = gray.astype(np.float64)
    return to_bytes(values - cv2.GaussianBlur(values, (0, 0), LOCAL_SIGMA) + MIDDLE)


def gradient_magnitude(gray, _):
    values = gray.astype(np.float64)
    along = [cv2.Sobel(values, cv2.CV_64F, *order, scale=1.0 / 8.0) for order in ((1, 0), (0, 1))]
    return to_bytes(GRADIENT_GAIN * np.hypot(*along))


def rank(gray, _):
    """Number of the eight neighbors that are darker. Every curve that keeps the order of
    neighbors drops out, and with it how large their differences are."""
    smooth = cv2.GaussianBlur(gray.astype(np.float64), (0, 0), RANK_SIGMA)
    rows, columns = smooth.shape
    padded = np.pad(smooth, 1, "edge")
    darker = np.zeros_like(smooth)
    for v in range(3):
        for u in range(3):
            darker += padded[v:v + rows, u:u + columns] < smooth - DARKER
    return to_bytes(cv2.GaussianBlur(RANK_STEP * darker, (0, 0), RANK_SIGMA))


def locally_normalized(gray, _):
    """(I - mean) / (deviation + constant) of the window around each pixel. A gain and an offset
    that vary slowly drop out."""
    values = gray.astype(np.float64)
    mean = cv2.blur(values, WINDOW)
    variance = np.maximum(cv2.blur(values * values, WINDOW) - mean * mean, 0.0)
    constant = max(CONTRAST_SHARE * np.sqrt(variance.mean()), 1e-6)
    return to_bytes((values - mean) / (np.sqrt(variance) + constant) * GRAY_LEVELS + MIDDLE)


def to_bytes(values):
    return np.clip(np.rint(values), 0, 255).astype(np.uint8)


def mapped(folder, source, image_map):
    """A sequence whose color images are mapped; its depth is a link to the source's."""
    def make():
        os.makedirs(os.path.join(folder, "rgb"))
        for name in keys.LISTS:
            if os.path.exists(os.path.join(source, name)):
                shutil.copy(os.path.join(source, name), folder)
        os.symlink(os.path.relpath(os.path.join(source, "depth"), folder),
                   os.path.join(folder, "depth"))
        map_images(folder, source, image_map)
    recipe = ["mapped", image_map.__name__, keys.file_key(os.path.realpath(__file__)),
              keys.sequence_key(source)]
    return make_once(folder, recipe, make)


def map_images(folder, source, image_map):
    first = None
    for path in color_paths(source):
        # The tracker makes its gray images in the same way.
        gray = cv2.cvtColor(cv2.imread(os.path.join(source, path)), cv2.COLOR_BGR2GRAY)
        first = gray if first is None else first
        cv2.imwrite(os.path.join(folder, path), image_map(gray, first),
                    [cv2.IMWRITE_PNG_COMPRESSION, 1])


def color_paths(folder):
    """As the list of the sequence has them, relative to it."""
    with open(os.path.join(folder, "rgb.txt"), encoding="utf-8") as file:
        return [line.split()[1] for line in file if line.strip() and not line.startswith("#")]
