# SPDX-License-Identifier: BSD-3-Clause
"""A small recording, rendered in closed form, and what can be done to its files."""
import os
import shutil

import cv2
import numpy

FRAMES = 24
RATE = 30.0  # Hz
FIRST = 100.0  # s

# The walls n . X = d of the world, m: a corner seen from inside, so that the six motions are apart.
WALLS = [((0.0, 0.0, 1.0), 2.2), ((1.0, 0.0, 0.2), 1.1), ((-1.0, 0.1, 0.1), 1.0),
         ((0.0, 1.0, 0.1), 0.8)]
TWIST = numpy.array([0.006, -0.003, 0.004, 0.002, 0.004, -0.003])  # m, rad, per frame


class Camera:
    def __init__(self, width, height, focal, cx=None, cy=None):
        self.width, self.height, self.focal = width, height, focal
        self.cx = 0.5 * (width - 1) if cx is None else cx
        self.cy = 0.5 * (height - 1) if cy is None else cy

    def line(self, units=1000):
        """What stands in camera.txt."""
        return "{} {} {} {} {} {} {}\n".format(self.width, self.height, self.focal, self.focal,
                                               self.cx, self.cy, units)


SMALL = Camera(320, 240, 280.0)


def stamps():
    return [FIRST + i / RATE for i in range(FRAMES)]


def pose(i):
    """Rotation and position of frame i: i steps of a screw."""
    rotation, _ = cv2.Rodrigues(i * TWIST[3:])
    half, _ = cv2.Rodrigues(0.5 * i * TWIST[3:])
    return rotation, half @ (i * TWIST[:3])


def texture(points):
    """Gray value of points of the world: waves of several lengths and directions, with edges."""
    value = numpy.zeros(points.shape[:-1])
    for k in range(1, 8):
        direction = numpy.array([numpy.cos(2.4 * k), numpy.sin(2.4 * k), numpy.cos(1.3 * k)])
        value += numpy.sin((5.0 + 5.0 * k) * (points @ direction) + k)
    return 125.0 + 80.0 * numpy.tanh(1.5 * value)


def render(i, camera=SMALL):
    """Color, blue first, and depth in millimeters."""
    rotation, position = pose(i)
    v, u = numpy.mgrid[0:camera.height, 0:camera.width].astype(float)
    rays = numpy.dstack([(u - camera.cx) / camera.focal, (v - camera.cy) / camera.focal,
                         numpy.ones_like(u)]) @ rotation.T
    depth = numpy.full(u.shape, numpy.inf)
    for normal, distance in WALLS:
        towards = rays @ numpy.array(normal)
        wall = (distance - numpy.array(normal) @ position) / numpy.maximum(towards, 1e-9)
        depth = numpy.minimum(depth, wall)
    gray = texture(depth[..., None] * rays + position)
    color = numpy.dstack([0.9 * gray, gray, numpy.minimum(1.1 * gray, 255.0)])
    return numpy.rint(color).astype(numpy.uint8), numpy.rint(1000.0 * depth).astype(numpy.uint16)


def quaternion(rotation):
    w = 0.5 * numpy.sqrt(1.0 + numpy.trace(rotation))
    return [(rotation[2, 1] - rotation[1, 2]) / (4 * w), (rotation[0, 2] - rotation[2, 0]) / (4 * w),
            (rotation[1, 0] - rotation[0, 1]) / (4 * w), w]


def truth(times=None):
    """The lines of a trajectory, as lists of words."""
    lines = []
    for i, stamp in enumerate(times or stamps()):
        rotation, position = pose(i)
        lines.append(["{:.6f}".format(stamp)] +
                     ["{:.9f}".format(value) for value in (*position, *quaternion(rotation))])
    return lines


def same(_, image):
    return image


class Folder:
    """A sequence folder that is written file by file."""

    def __init__(self, path):
        self.path = path
        shutil.rmtree(path, ignore_errors=True)
        os.makedirs(path)

    def write(self, name, content):
        path = os.path.join(self.path, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as stream:
            stream.write(content if isinstance(content, bytes) else content.encode())

    def image(self, name, pixels):
        ok, encoded = cv2.imencode(os.path.splitext(name)[1], pixels)
        assert ok, name
        self.write(name, encoded.tobytes())

    def truth(self, times=None):
        self.write("groundtruth.txt", "".join(" ".join(words) + "\n" for words in truth(times)))

    def images(self, color_name, depth_name, color=same, depth=same, camera=SMALL):
        """All frames; the names have the frame's number for {i} and its time, us, for {us}."""
        for i in range(FRAMES):
            color_image, depth_image = render(i, camera)
            names = {"i": i, "us": round(1e6 * i / RATE)}
            self.image(color_name.format(**names), color(i, color_image))
            self.image(depth_name.format(**names), depth(i, depth_image))

    def pairs(self, color="rgb/{i}.png", depth="depth/{i}.png", times=None, change=None):
        """associations.txt; `change` turns the list of lines into another."""
        lines = ["{0} {1} {0} {2}".format("{:.6f}".format(t), color.format(i=i), depth.format(i=i))
                 for i, t in enumerate(times or stamps())]
        self.write("associations.txt", "\n".join(change(lines) if change else lines) + "\n")

    def lists(self, color_times, depth_times):
        """rgb.txt and depth.txt; the times are texts."""
        for name, times in (("rgb", color_times), ("depth", depth_times)):
            self.write(name + ".txt", "".join("{} {}/{}.png\n".format(t, name, i)
                                              for i, t in enumerate(times)))

    def plain(self, color=same, depth=same, color_ending=".png", depth_ending=".png",
              camera_line=None, camera=SMALL):
        """TUM's layout, with pairs."""
        self.write("camera.txt", camera_line or camera.line())
        self.images("rgb/{i}" + color_ending, "depth/{i}" + depth_ending, color, depth, camera)
        self.pairs("rgb/{i}" + color_ending, "depth/{i}" + depth_ending)
        self.truth()
