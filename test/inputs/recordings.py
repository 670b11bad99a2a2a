# SPDX-License-Identifier: BSD-3-Clause
"""Bags as strangers record them, made of one generated bag by changing its messages."""

import copy
import os
import struct
import subprocess

import cv2
import genpy
import numpy
import rosbag
from sensor_msgs.msg import CompressedImage, Image

COLOR = "/camera/rgb/image_raw"
DEPTH = "/camera/depth_registered/image_raw"
INFO = "/camera/rgb/camera_info"
DAY = 1600000000  # s, of the stamps


def pixels(message):
    """The array of a raw message of the generated bag."""
    types = {"rgb8": ("u1", 3), "bgr8": ("u1", 3), "mono8": ("u1", 1), "16UC1": ("u2", 1)}
    kind, channels = types[message.encoding]
    array = numpy.frombuffer(message.data, kind).reshape(message.height, message.width, channels)
    return array if channels > 1 else array[:, :, 0]


def rgb(message):
    array = pixels(message)
    return array if message.encoding == "rgb8" else array[:, :, ::-1]


def gray(message):
    return cv2.cvtColor(numpy.ascontiguousarray(rgb(message)), cv2.COLOR_RGB2GRAY)


def image(like, array, encoding):
    array = numpy.ascontiguousarray(array)
    message = Image(header=copy.deepcopy(like.header), encoding=encoding)
    message.height, message.width = array.shape[:2]
    message.step = array.strides[0]
    message.data = array.tobytes()
    return message


def compressed(like, data, text):
    return CompressedImage(header=copy.deepcopy(like.header), format=text, data=bytes(data))


def png(array):
    return cv2.imencode(".png", numpy.ascontiguousarray(array))[1].tobytes()


def jpeg(array):
    return cv2.imencode(".jpg", numpy.ascontiguousarray(array), [cv2.IMWRITE_JPEG_QUALITY, 97])[1].tobytes()


def rvl(depth):
    """As compressed_depth_image_transport: columns, rows, then the words of RVL."""
    nibbles = []

    def put(value):
        while True:
            part, value = value & 7, value >> 3
            nibbles.append(part | (8 if value else 0))
            if not value:
                return

    flat = depth.astype(int).ravel()
    at, before = 0, 0
    while at < len(flat):
        start = at
        while at < len(flat) and flat[at] == 0:
            at += 1
        put(at - start)
        start = at
        while at < len(flat) and flat[at] != 0:
            at += 1
        put(at - start)
        for value in flat[start:at]:
            difference, before = int(value) - before, int(value)
            put(difference << 1 ^ difference >> 63)
    nibbles += [0] * (-len(nibbles) % 8)
    words = [sum(n << 4 * (7 - k) for k, n in enumerate(nibbles[i:i + 8])) for i in range(0, len(nibbles), 8)]
    return struct.pack("<ii", depth.shape[1], depth.shape[0]) + struct.pack("<%dI" % len(words), *words)


def mosaic(array, pattern="rggb"):
    result = numpy.empty(array.shape[:2], array.dtype)
    for k, color in enumerate(pattern):
        result[k // 2::2, k % 2::2] = array[k // 2::2, k % 2::2, "rgb".index(color)]
    return result


def yuyv(message):
    yuv = cv2.cvtColor(numpy.ascontiguousarray(rgb(message)), cv2.COLOR_RGB2YUV)
    # Of video range, as cameras send it.
    packed = numpy.empty(yuv.shape[:2] + (2,), "u1")
    packed[..., 0] = (16 + yuv[..., 0].astype(float) * 219 / 255).round()
    packed[:, 0::2, 1] = yuv[:, 0::2, 1]
    packed[:, 1::2, 1] = yuv[:, 0::2, 2]
    return packed


def nv12(message):
    luminance = (16 + gray(message).astype(float) * 219 / 255).round().astype("u1")
    return numpy.vstack([luminance, numpy.full((message.height // 2, message.width), 128, "u1")])


class Recordings:
    """Where the generated bag is, and the bags that are made of it."""

    def __init__(self, build, folder, frames=40):
        self.build = build
        self.folder = folder
        self.frames = frames
        sequence = os.path.join(folder, "sequence")
        self.run("generate_sequence", sequence, "--frames", str(frames), "--width", "320", "--height",
                 "240", "--depth-units", "1000", "--samples", "2")
        early = os.path.join(folder, "early.bag")
        self.run("sequence_to_bag", sequence, early, "--layout", "openni2")
        self.base = os.path.join(folder, "base.bag")
        with rosbag.Bag(early) as source, rosbag.Bag(self.base, "w") as bag:
            for topic, message, time in source.read_messages():
                if topic not in (COLOR, DEPTH, INFO, "/tf_static"):
                    continue
                if topic != "/tf_static":
                    message.header.stamp += genpy.Duration(DAY)
                bag.write(topic, message, time + genpy.Duration(DAY))
        self.truth = os.path.join(folder, "truth.txt")
        with open(os.path.join(sequence, "groundtruth.txt"), encoding="utf-8") as source, \
                open(self.truth, "w", encoding="utf-8") as file:
            for line in source:
                if not line.startswith("#"):
                    stamp, rest = line.split(" ", 1)
                    file.write("%.6f %s" % (float(stamp) + DAY, rest))

    def run(self, program, *arguments, check=True):
        return subprocess.run([os.path.join(self.build, "bin", program), *arguments], text=True, check=check,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def path(self, name):
        return os.path.join(self.folder, name)

    def change(self, name, change, compression="none"):
        """A bag of what change(topic, message, time, number of the message on its topic) makes of each
        message: pairs of a topic and a message, or those with a time; None for the message as it is."""
        path = self.path(name)
        numbers = {}
        with rosbag.Bag(self.base) as source, rosbag.Bag(path, "w", compression=compression) as bag:
            for topic, message, time in source.read_messages():
                number = numbers.get(topic, 0)
                numbers[topic] = number + 1
                made = change(topic, message, time, number)
                for item in [(topic, message)] if made is None else made:
                    bag.write(item[0], item[1], item[2] if len(item) > 2 else time)
        return path

    def color(self, name, convert, topic=COLOR):
        return self.change(name, lambda t, m, time, n: [(topic, convert(m))] if t == COLOR else None)

    def depth(self, name, convert, topic=DEPTH):
        return self.change(name, lambda t, m, time, n: [(topic, convert(m))] if t == DEPTH else None)

    def info(self, name, edit):
        def change(topic, message, _time, number):
            if topic != INFO:
                return None
            message = copy.deepcopy(message)
            return [(topic, message)] if edit(message, number) is not False else []
        return self.change(name, change)

    def stamps(self, name, stamp, topics=(COLOR, DEPTH, INFO)):
        """@param stamp  of the true stamp (s), the number and the topic of a message"""
        def change(topic, message, _time, number):
            if topic not in topics:
                return None
            message = copy.deepcopy(message)
            message.header.stamp = genpy.Time.from_sec(stamp(message.header.stamp.to_sec(), number, topic))
            return [(topic, message)]
        return self.change(name, change)

    def bytes_of(self, name, change):
        """A bag whose bytes are changed."""
        with open(self.base, "rb") as file:
            data = bytearray(file.read())
        with open(self.path(name), "wb") as file:
            file.write(change(data))
        return self.path(name)
