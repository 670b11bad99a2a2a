# SPDX-License-Identifier: BSD-3-Clause
"""Sequences of the benchmarks: filmed, relit, or put together from other sequences' frames."""

import os
import shutil

import numpy as np
from PIL import Image

WIDTH, HEIGHT = 640, 480


def is_complete(folder):
    return os.path.exists(os.path.join(folder, "complete"))


def complete(folder):
    with open(os.path.join(folder, "complete"), "w", encoding="utf-8") as file:
        file.write("made by mivo's benchmarks; delete the folder to have it made anew\n")


def generate(programs, folder, frames, scene, trajectory, lighting, seed, options=()):
    """Films a sequence unless it is there."""
    if not is_complete(folder):
        programs.run("generate_sequence", folder, "--force", "--frames", str(frames), "--scene",
                     scene, "--trajectory", trajectory, "--lighting", lighting, "--seed", str(seed),
                     *options)
        complete(folder)
    return folder


def relight(programs, source, folder, lighting, seed=1):
    """Relights a sequence unless that is there."""
    if not is_complete(folder):
        if os.path.isdir(folder):
            shutil.rmtree(folder)
        programs.run("relight_sequence", source, folder, "--lighting", lighting, "--seed",
                     str(seed))
        complete(folder)
    return folder


class Frames:
    """Frames of a sequence by reference: what each shows, its depth, and its true pose."""

    def __init__(self, folder):
        self.folder = os.path.abspath(folder)
        self.colour = self._list("rgb.txt")
        self.depth = self._list("depth.txt")
        self.truth = [row.split()[1:] for row in self._rows("groundtruth.txt")]

    def _rows(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return [line for line in file if line.strip() and not line.startswith("#")]

    def _list(self, name):
        return [os.path.join(self.folder, row.split()[1]) for row in self._rows(name)]

    def frame(self, i):
        return self.colour[i], self.depth[i], self.truth[i]


def compose(folder, camera_of, frames, period=1.0 / 30.0):
    """A sequence whose frames are (colour path, depth path, true pose as seven words)."""
    os.makedirs(folder, exist_ok=True)
    shutil.copy(os.path.join(camera_of, "camera.txt"), folder)
    with open(os.path.join(folder, "rgb.txt"), "w", encoding="utf-8") as colour, \
            open(os.path.join(folder, "depth.txt"), "w", encoding="utf-8") as depth, \
            open(os.path.join(folder, "groundtruth.txt"), "w", encoding="utf-8") as truth:
        for i, (colour_path, depth_path, pose) in enumerate(frames):
            stamp = f"{1000.0 + i * period:.6f}"
            colour.write(f"{stamp} {os.path.relpath(colour_path, folder)}\n")
            depth.write(f"{stamp} {os.path.relpath(depth_path, folder)}\n")
            truth.write(f"{stamp} {' '.join(pose)}\n")
    complete(folder)
    return folder


def write_png(path, pixels):
    Image.fromarray(pixels).save(path)
    return path


def covered(folder, source, first, count, seed=1):
    """`count` frames from `first` on show nothing but the noise of a covered lens, no depth. The
    camera waits at the last frame before: the view is known when the cover is taken off."""
    if is_complete(folder):
        return folder
    os.makedirs(folder, exist_ok=True)
    random = np.random.default_rng(seed)
    dark = [write_png(os.path.join(folder, f"covered_{k}.png"),
                      random.integers(0, 3, (HEIGHT, WIDTH, 3), dtype=np.uint8)) for k in range(5)]
    empty = write_png(os.path.join(folder, "no_depth.png"), np.zeros((HEIGHT, WIDTH), np.uint16))
    frames = Frames(source)
    sequence = [frames.frame(i) for i in range(first)]
    sequence += [(dark[k % 5], empty, frames.truth[first - 1]) for k in range(count)]
    sequence += [frames.frame(i) for i in range(first, len(frames.colour))]
    return compose(folder, source, sequence)


def without_depth(folder, source, first, count):
    """`count` frames from `first` on have no depth."""
    if is_complete(folder):
        return folder
    os.makedirs(folder, exist_ok=True)
    empty = write_png(os.path.join(folder, "no_depth.png"), np.zeros((HEIGHT, WIDTH), np.uint16))
    frames = Frames(source)
    sequence = [frames.frame(i) for i in range(len(frames.colour))]
    for i in range(first, first + count):
        sequence[i] = (sequence[i][0], empty, sequence[i][2])
    return compose(folder, source, sequence)


def teleported(folder, source, first, count):
    """`count` frames are missing from `first` on, and no stamp says so."""
    if is_complete(folder):
        return folder
    frames = Frames(source)
    return compose(folder, source, [frames.frame(i) for i in range(len(frames.colour))
                                    if not first <= i < first + count])


def joined(folder, first_source, second_source, count):
    """`count` frames of each of two places; the second is true 100 m away."""
    if is_complete(folder):
        return folder
    a, b = Frames(first_source), Frames(second_source)
    sequence = [a.frame(i) for i in range(count)]
    for i in range(count):
        colour, depth, pose = b.frame(i)
        sequence.append((colour, depth, [f"{float(pose[0]) + 100.0:.6f}"] + pose[1:]))
    return compose(folder, first_source, sequence)


def blurred(folder, source, first, count, length=41):
    """`count` frames from `first` on are smeared over `length` pixels along their rows."""
    if is_complete(folder):
        return folder
    os.makedirs(folder, exist_ok=True)
    frames = Frames(source)
    sequence = [frames.frame(i) for i in range(len(frames.colour))]
    for i in range(first, first + count):
        pixels = np.asarray(Image.open(sequence[i][0]).convert("RGB"), np.float64)
        sums = np.cumsum(np.pad(pixels, ((0, 0), (length // 2 + 1, length // 2), (0, 0)), "edge"),
                         axis=1)
        mean = (sums[:, length:] - sums[:, :-length]) / length
        path = write_png(os.path.join(folder, f"blurred_{i}.png"),
                         np.clip(np.rint(mean), 0, 255).astype(np.uint8))
        sequence[i] = (path, sequence[i][1], sequence[i][2])
    return compose(folder, source, sequence)
