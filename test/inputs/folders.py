# SPDX-License-Identifier: BSD-3-Clause
"""Sequence folders that strangers have: a name, and what makes the folder, row by row."""
import os
import random

import cv2
import numpy

from sequence import FIRST, FRAMES, RATE, SMALL, Camera, stamps

VGA = (640, 480)


def gray(image, bits):
    return cv2.cvtColor(image, cv2.COLOR_BGR2GRAY).astype(numpy.uint16) << (bits - 8)


def rotated(depth, left):
    wide = depth.astype(numpy.uint32)
    return ((wide << left | wide >> (16 - left)) & 0xFFFF).astype(numpy.uint16)


def every(step, offset, image_of):
    """A change of every step-th image; the others stay."""
    return lambda i, image: image_of(i) if i % step == offset else image


def color_of(frame):
    from sequence import render
    return render(frame)[0]


def larger(size):
    return lambda i, image: cv2.resize(image, size, interpolation=cv2.INTER_LINEAR)


def truncated(folder):
    folder.plain()
    path = os.path.join(folder.path, "rgb", "5.png")
    with open(path, "rb") as stream:
        content = stream.read()
    folder.write("rgb/5.png", content[:-100])


def missing(folder):
    folder.plain()
    os.remove(os.path.join(folder.path, "depth", "7.png"))


IMAGES = [
    ("PNG of 8 bits and color: the twin of all others", lambda f: f.plain()),
    ("color as JPEG", lambda f: f.plain(color_ending=".jpg")),
    ("color with an alpha channel",
     lambda f: f.plain(color=lambda i, c: cv2.cvtColor(c, cv2.COLOR_BGR2BGRA))),
    ("color of 16 bits", lambda f: f.plain(color=lambda i, c: c.astype(numpy.uint16) * 257)),
    ("gray of 8 bits", lambda f: f.plain(color=lambda i, c: cv2.cvtColor(c, cv2.COLOR_BGR2GRAY))),
    ("gray of 16 bits", lambda f: f.plain(color=lambda i, c: gray(c, 16))),
    ("gray of 12 bits in 16", lambda f: f.plain(color=lambda i, c: gray(c, 12))),
    ("gray of 10 bits in 16", lambda f: f.plain(color=lambda i, c: gray(c, 10))),
    ("color twice as large as depth, camera of the color",
     lambda f: f.plain(color=larger((640, 480)), camera_line=Camera(640, 480, 560.0).line())),
    ("color twice as large as depth, camera of the depth",
     lambda f: f.plain(color=larger((640, 480)))),
    ("color 1.25 times as large as depth", lambda f: f.plain(color=larger((400, 300)))),
    ("a tenth of the color images repeat the one before",
     lambda f: f.plain(color=every(10, 5, lambda i: color_of(i - 1)))),
    ("a truncated color image", truncated),
    ("a missing depth image", missing),
    ("depth as PGM", lambda f: f.plain(depth_ending=".pgm")),
    ("depth as TIFF", lambda f: f.plain(depth_ending=".tiff")),
    ("depth of 8 bits", lambda f: f.plain(depth=lambda i, d: (d // 16).astype(numpy.uint8))),
    ("depth in three channels", lambda f: f.plain(depth=lambda i, d: cv2.merge([d, d, d]))),
    ("depth in steps of 0.1 m", lambda f: f.plain(depth=lambda i, d: d // 100 * 100)),
    ("depth without readings", lambda f: f.plain(depth=lambda i, d: d * 0)),
    ("millimeters, camera.txt says 5000 units per meter",
     lambda f: f.plain(camera_line=SMALL.line(5000))),
    ("millimeters, camera.txt says 1 unit per meter",
     lambda f: f.plain(camera_line=SMALL.line(1))),
    ("depth rotated by three bits to the left (SUN RGB-D)",
     lambda f: f.plain(depth=lambda i, d: rotated(d, 3))),
    ("the same, camera.txt says 8000 units per meter",
     lambda f: f.plain(depth=lambda i, d: rotated(d, 3), camera_line=SMALL.line(8000))),
    ("depth rotated by three bits to the right",
     lambda f: f.plain(depth=lambda i, d: rotated(d, 13))),
]


def shuffled(lines):
    lines = list(lines)
    random.Random(1).shuffle(lines)
    return lines


def swapped(lines):
    return [" ".join([w[2], w[3], w[0], w[1]]) for w in (line.split() for line in lines)]


def with_pairs(change):
    def make(folder):
        folder.plain()
        folder.pairs(change=change)
    return make


def blanks(quote):
    def make(folder):
        folder.plain()
        for name in ("rgb", "depth"):
            os.rename(os.path.join(folder.path, name), os.path.join(folder.path, "my " + name))
        folder.pairs(quote + "my rgb/{i}.png" + quote, quote + "my depth/{i}.png" + quote)
    return make


def windows(folder):
    folder.plain()
    folder.pairs(change=lambda lines: ["\ufeff# comment\r"] + [line + "\r" for line in lines])


LISTS = [
    ("associations.txt names depth first", with_pairs(swapped)),
    ("associations.txt reversed", with_pairs(lambda lines: lines[::-1])),
    ("associations.txt shuffled", with_pairs(shuffled)),
    ("associations.txt has each line twice",
     with_pairs(lambda lines: [line for line in lines for _ in (0, 1)])),
    ("blanks in the paths", blanks("")),
    ("blanks in the paths, in quotes", blanks('"')),
    ("byte order mark, carriage returns", windows),
    ("a line without a second path", with_pairs(lambda lines: [lines[0].rsplit(" ", 1)[0]] + lines)),
]


def with_lists(color, depth):
    """Without pairs; functions from a stamp (s) and a number to a text."""
    def make(folder):
        folder.plain()
        os.remove(os.path.join(folder.path, "associations.txt"))
        folder.lists([color(t, i) for i, t in enumerate(stamps())],
                     [depth(t, i) for i, t in enumerate(stamps())])
    return make


def seconds(offset=0.0):
    return lambda t, i: "{:.6f}".format(t + offset)


def whole(factor):
    return lambda t, i: str(round(t * factor))


def of_today(zeros):
    return lambda t, i: "0" if i < zeros else "{:.6f}".format(t + 1.6e9)


STAMPS = [
    ("rgb.txt and depth.txt, 10 ms apart", with_lists(seconds(), seconds(0.01))),
    ("nanoseconds", with_lists(whole(1e9), whole(1e9))),
    ("microseconds", with_lists(whole(1e6), whole(1e6))),
    ("the first three are zero, the others of today", with_lists(of_today(3), of_today(3))),
    ("all are zero", with_lists(lambda t, i: "0", lambda t, i: "0")),
    ("every second one is 3 s earlier",
     with_lists(lambda t, i: "{:.6f}".format(t - 3 * (i % 2)),
                lambda t, i: "{:.6f}".format(t - 3 * (i % 2)))),
    ("depth 0.7 s later than color, another clock", with_lists(seconds(), seconds(0.7))),
    ("depth 15 ms later, a third of it missing",
     with_lists(seconds(), lambda t, i: "{:.6f}".format(t + 0.015 + 5.0 * (i % 3 == 2)))),
]


def icl(folder):
    camera = Camera(*VGA, 481.0)
    folder.images("rgb/{i}.png", "depth/{i}.png", depth=lambda i, d: d * 5, camera=camera)
    folder.pairs(times=None, change=lambda lines: [
        "{0} depth/{0}.png {0} rgb/{0}.png".format(i) for i in range(len(lines))])
    folder.truth([float(i) for i in range(FRAMES)])


def bonn(folder):
    folder.images("rgb/{i}.png", "depth/{i}.png", depth=lambda i, d: d * 5,
                  camera=Camera(*VGA, 542.7, 315.6, 237.8))
    folder.lists(["{:.6f}".format(t) for t in stamps()], ["{:.6f}".format(t) for t in stamps()])
    folder.truth()


def eth3d(folder):
    folder.plain(depth=lambda i, d: d * 5)
    os.remove(os.path.join(folder.path, "camera.txt"))
    os.rename(os.path.join(folder.path, "associations.txt"),
              os.path.join(folder.path, "associated.txt"))
    folder.write("calibration.txt", "{0} {0} {1} {2}\n".format(SMALL.focal, SMALL.cx, SMALL.cy))


def from_zero(folder):
    folder.truth([i / RATE for i in range(FRAMES)])


def seven_scenes(folder):
    folder.images("frame-{i:06d}.color.png", "frame-{i:06d}.depth.png",
                  camera=Camera(*VGA, 585.0, 320.0, 240.0))
    from_zero(folder)


def matrix(camera, size):
    rows = numpy.eye(size)
    rows[0, 0] = rows[1, 1] = camera.focal
    rows[0, 2], rows[1, 2] = camera.cx, camera.cy
    return "".join(" ".join(str(value) for value in row) + "\n" for row in rows)


def match_3d(last_row):
    def make(folder):
        folder.images("frame-{i:06d}.color.png", "frame-{i:06d}.depth.png")
        folder.write("camera-intrinsics.txt",
                     "\n".join(matrix(SMALL, 3).split("\n")[:2]) + "\n" + last_row + "\n")
        from_zero(folder)
    return make


def scannet(folder):
    folder.images("color/{i}.jpg", "depth/{i}.png", color=larger((648, 484)))
    folder.write("intrinsic/intrinsic_depth.txt", matrix(SMALL, 4))
    from_zero(folder)


def scannet_stream(folder):
    folder.images("frame-{i:06d}.color.jpg", "frame-{i:06d}.depth.pgm", color=larger((648, 484)))
    folder.write("_info.txt", "m_depthShift = 1000\nm_calibrationDepthIntrinsic = {}\n".format(
        matrix(SMALL, 4).replace("\n", " ")))
    from_zero(folder)


def sun3d(folder):
    folder.images("image/{i:07d}-{us:012d}.jpg", "depth/{i:07d}-{us:012d}.png",
                  depth=lambda i, d: rotated(d, 3))
    folder.write("intrinsics.txt", matrix(SMALL, 3))
    from_zero(folder)


def numbered(folder):
    folder.images("color/{i:06d}.jpg", "depth/{i:06d}.png")
    folder.write("camera.txt", SMALL.line())
    from_zero(folder)


def above(folder):
    inner = type(folder)(os.path.join(folder.path, "inner"))
    inner.plain()


LAYOUTS = [
    ("ICL-NUIM: frame numbers, depth first, no camera", icl),
    ("Bonn: a folder named rgbd_bonn_..., no camera", bonn),
    ("ETH3D-SLAM: associated.txt, calibration.txt", eth3d),
    ("7-Scenes: frame-000000.color.png", seven_scenes),
    ("3DMatch: the same with camera-intrinsics.txt", match_3d("0 0 1")),
    ("3DMatch, the last row of K is 0 0 0", match_3d("0 0 0")),
    ("ScanNet: color/0.jpg, depth/0.png, intrinsic", scannet),
    ("ScanNet: frame-000000.color.jpg, .depth.pgm, _info.txt", scannet_stream),
    ("SUN3D: image/0000001-000000033333.jpg, intrinsics.txt", sun3d),
    ("color/000000.jpg, depth/000000.png, camera.txt", numbered),
    ("the folder above a sequence", above),
    ("a folder with nothing in it", lambda folder: None),
]


def with_camera(line):
    return lambda folder: folder.plain(camera_line=line)


def small(folder):
    folder.plain(camera=Camera(80, 60, 70.0))


CAMERAS = [
    ("fy is negative (ICL-NUIM's y axis)", with_camera("320 240 280 -280 159.5 119.5 1000\n")),
    ("fx = fy = 1", with_camera("320 240 1 1 159.5 119.5 1000\n")),
    ("fx = fy = 28000", with_camera("320 240 28000 28000 159.5 119.5 1000\n")),
    ("cx = -5000", with_camera("320 240 280 280 -5000 119.5 1000\n")),
    ("calibrated at twice the size", with_camera("320 240 560 560 319.5 239.5 1000\n")),
    ("calibrated at half the size", with_camera("320 240 140 140 79.5 59.5 1000\n")),
    ("calibrated at half the size, and says so", with_camera("160 120 140 140 79.5 59.5 1000\n")),
    ("images of 80 x 60 pixels", small),
    ("six numbers", with_camera("320 240 280 280 159.5 119.5\n")),
]

GROUPS = [("Images", IMAGES), ("Lists", LISTS), ("Stamps", STAMPS), ("Layouts", LAYOUTS),
          ("Cameras", CAMERAS)]
