# SPDX-License-Identifier: BSD-3-Clause
"""Sequences with events, composed of the frames of other sequences."""

import os
import shutil

import numpy as np
from PIL import Image

from measuring import keys
from measuring.sequences import make_once


class Frames:
    """Frames of a sequence by reference: what each shows, its depth, and its true pose."""

    def __init__(self, folder):
        self.folder = os.path.abspath(folder)
        self.color = self._list("rgb.txt")
        self.depth = self._list("depth.txt")
        self.truth = [row.split()[1:] for row in self._rows("groundtruth.txt")]

    def _rows(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return [line for line in file if line.strip() and not line.startswith("#")]

    def _list(self, name):
        return [os.path.join(self.folder, row.split()[1]) for row in self._rows(name)]

    def frame(self, i):
        return self.color[i], self.depth[i], self.truth[i]

    def all(self):
        return [self.frame(i) for i in range(len(self.color))]

    def shape(self):
        """Rows and columns."""
        with Image.open(self.color[0]) as picture:
            return picture.size[::-1]


def compose(folder, sources, event, frames_of, gap=(0, 0.0)):
    """A sequence with the camera of the first source. The event is a list of words and numbers,
    frames_of() gives (color path, depth path, true pose as seven words) for each frame."""
    def make():
        os.makedirs(folder)
        shutil.copy(os.path.join(sources[0], "camera.txt"), folder)
        write_lists(folder, frames_of(), gap=gap)
    recipe = event + [keys.file_key(os.path.realpath(__file__))] + [keys.sequence_key(source)
                                                                    for source in sources]
    return make_once(folder, recipe, make)


def write_lists(folder, frames, period=1.0 / 30.0, gap=(0, 0.0)):
    """`gap`: from which frame on stamps are by how many seconds later."""
    with open(os.path.join(folder, "rgb.txt"), "w", encoding="utf-8") as color, \
            open(os.path.join(folder, "depth.txt"), "w", encoding="utf-8") as depth, \
            open(os.path.join(folder, "groundtruth.txt"), "w", encoding="utf-8") as truth:
        for i, (color_path, depth_path, pose) in enumerate(frames):
            stamp = f"{1000.0 + i * period + (gap[1] if i >= gap[0] else 0.0):.6f}"
            color.write(f"{stamp} {os.path.relpath(color_path, folder)}\n")
            depth.write(f"{stamp} {os.path.relpath(depth_path, folder)}\n")
            truth.write(f"{stamp} {' '.join(pose)}\n")


def write_png(path, pixels):
    Image.fromarray(pixels).save(path)
    return path


def write_no_depth(folder, shape):
    return write_png(os.path.join(folder, "no_depth.png"), np.zeros(shape, np.uint16))


def write_covered(folder, shape, seed=1):
    """Five images of the noise of a covered lens."""
    random = np.random.default_rng(seed)
    return [write_png(os.path.join(folder, f"covered_{k}.png"),
                      random.integers(0, 3, shape + (3,), dtype=np.uint8)) for k in range(5)]


def covered(folder, source, first, count, seed=1):
    """`count` frames from `first` on show nothing but the noise of a covered lens, no depth. The
    camera waits at the last frame before: the view is known when the cover is taken off."""
    def frames_of():
        frames = Frames(source)
        dark = write_covered(folder, frames.shape(), seed)
        empty = write_no_depth(folder, frames.shape())
        known = frames.all()
        return known[:first] + [(dark[k % 5], empty, frames.truth[first - 1])
                                for k in range(count)] + known[first:]
    return compose(folder, [source], ["covered", first, count, seed], frames_of)


def without_depth(folder, source, first, count):
    """`count` frames from `first` on have no depth."""
    def frames_of():
        frames = Frames(source)
        empty = write_no_depth(folder, frames.shape())
        return [(color, empty if first <= i < first + count else depth, pose)
                for i, (color, depth, pose) in enumerate(frames.all())]
    return compose(folder, [source], ["without_depth", first, count], frames_of)


def teleported(folder, source, first, count):
    """`count` frames are missing from `first` on, and no stamp says so."""
    def frames_of():
        frames = Frames(source).all()
        return frames[:first] + frames[first + count:]
    return compose(folder, [source], ["teleported", first, count], frames_of)


def after_gap(folder, here, there, kind, seconds):
    """Half of a sequence, `seconds` without frames, and then another place (`elsewhere`), a covered
    lens for as many frames (`covered`), or the other half (`goes on`)."""
    def frames_of():
        frames = Frames(here)
        known = frames.all()
        middle = len(known) // 2
        if kind == "elsewhere":
            return known[:middle] + Frames(there).all()[middle:]
        if kind == "covered":
            dark, empty = write_covered(folder, frames.shape()), write_no_depth(folder,
                                                                                frames.shape())
            return known[:middle] + [(dark[k % len(dark)], empty, frames.truth[middle - 1])
                                     for k in range(middle)]
        return known
    return compose(folder, [here, there], ["after_gap", kind, seconds], frames_of,
                   (len(Frames(here).color) // 2, seconds))


def joined(folder, first_source, second_source, count):
    """`count` frames of each of two places; the second is true 100 m away."""
    def frames_of():
        there = Frames(second_source).all()[:count]
        return Frames(first_source).all()[:count] + [
            (color, depth, [f"{float(pose[0]) + 100.0:.6f}"] + pose[1:])
            for color, depth, pose in there]
    return compose(folder, [first_source, second_source], ["joined", count], frames_of)


def blurred(folder, source, first, count, length=41):
    """`count` frames from `first` on are smeared over `length` pixels along their rows."""
    def frames_of():
        frames = Frames(source).all()
        for i in range(first, first + count):
            path = os.path.join(folder, f"blurred_{i}.png")
            frames[i] = (smear(frames[i][0], path, length),) + frames[i][1:]
        return frames
    return compose(folder, [source], ["blurred", first, count, length], frames_of)


def smear(source, path, length):
    pixels = np.asarray(Image.open(source).convert("RGB"), np.float64)
    sums = np.cumsum(np.pad(pixels, ((0, 0), (length // 2 + 1, length // 2), (0, 0)), "edge"),
                     axis=1)
    mean = (sums[:, length:] - sums[:, :-length]) / length
    return write_png(path, np.clip(np.rint(mean), 0, 255).astype(np.uint8))
