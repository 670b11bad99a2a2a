#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What run_bag makes of bags as strangers have them: each row of the table in doc/inputs.md is run.

    test/ros/run_with_ros BUILD /usr/bin/python3 test/inputs/bags.py BUILD            fails when a row is not so
    test/ros/run_with_ros BUILD /usr/bin/python3 test/inputs/bags.py BUILD --write    writes the table
    test/inputs/bags.py BUILD --node    plays some of them through the node: the same poses as run_bag's
"""

import copy
import gzip
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

import cv2
import genpy
import numpy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

import recordings
from recordings import COLOR, DEPTH, INFO, compressed, gray, image, jpeg, mosaic, nv12, pixels, png, rgb, rvl, yuyv

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
DOCUMENT = os.path.join(ROOT, "doc", "inputs.md")
BEGIN, END = "<!-- bags: written by test/inputs/bags.py -->", "<!-- bags: end -->"

SAME = 1.5  # times the error of the bag as it was generated: the same but for noise


class Row:
    """A recording, what is expected of it (poses, and words that run_bag and the node say), and how it
    is told."""

    def __init__(self, group, title, make, poses, says="", outcome="", error=SAME, node_says=""):
        self.group, self.title, self.make = group, title, make
        self.poses, self.says, self.error, self.node_says = poses, says, error, node_says
        self.outcome = outcome or ("the same as the bag itself" if poses == ALL else "")


ALL = 40


def rows(r):
    """All of them; r: Recordings."""
    header = b"\0" * 12
    table = []

    def add(group, *arguments, **options):
        table.append(Row(group, *arguments, **options))

    def color(title, convert, *arguments, topic=COLOR, **options):
        add("Color", title, lambda: r.color("x.bag", convert, topic), *arguments, **options)

    def depth(title, convert, *arguments, topic=DEPTH, **options):
        add("Depth", title, lambda: r.depth("x.bag", convert, topic), *arguments, **options)

    def info(title, edit, *arguments, **options):
        add("Calibration", title, lambda: r.info("x.bag", edit), *arguments, **options)

    def stamps(title, stamp, *arguments, topics=(COLOR, DEPTH, INFO), **options):
        add("Stamps", title, lambda: r.stamps("x.bag", stamp, topics), *arguments, **options)

    color("`mono8`, `8UC1`", lambda m: image(m, gray(m), "8UC1"), ALL)
    color("`8UC3` (taken as bgr)", lambda m: image(m, rgb(m)[..., ::-1], "8UC3"), ALL)
    color("`bgra8`, `8UC4`", lambda m: image(m, cv2.cvtColor(rgb(m).copy(), cv2.COLOR_RGB2BGRA), "8UC4"), ALL)
    color("`rgb16`, `bgr16`", lambda m: image(m, rgb(m).astype("u2") * 257, "rgb16"), ALL)
    color("`mono16` of 16 bits", lambda m: image(m, gray(m).astype("u2") * 257, "mono16"), ALL)
    color("`mono16` of 12 bits", lambda m: image(m, gray(m).astype("u2") * 16, "mono16"), ALL)
    color("`mono16` of 10 bits", lambda m: image(m, gray(m).astype("u2") * 4, "mono16"), ALL)
    color("`yuyv`, `yuv422_yuy2`", lambda m: image(m, yuyv(m), "yuv422_yuy2"), ALL)
    color("`yuv422` (UYVY)", lambda m: image(m, yuyv(m)[..., ::-1], "yuv422"), ALL)
    color("`nv12`, `nv21`", lambda m: image(m, nv12(m), "nv12"), ALL)
    color("`bayer_rggb8` and the other three", lambda m: image(m, mosaic(rgb(m)), "bayer_rggb8"), ALL,
           outcome="demosaiced", error=3.0)
    color("`bayer_rggb16` and the other three",
           lambda m: image(m, mosaic(rgb(m).astype("u2") * 257), "bayer_rggb16"), ALL, outcome="demosaiced",
           error=3.0)
    color("JPEG", lambda m: compressed(m, jpeg(rgb(m)[..., ::-1]), "rgb8; jpeg compressed bgr8"), ALL,
           topic=COLOR + "/compressed")
    color("JPEG, padded with zeros",
           lambda m: compressed(m, jpeg(rgb(m)[..., ::-1]) + b"\0" * 200, "rgb8; jpeg compressed bgr8"), ALL,
           topic=COLOR + "/compressed")
    color("Bayer inside of a JPEG or PNG",
           lambda m: compressed(m, png(mosaic(rgb(m))), "bayer_rggb8; png compressed "), ALL,
           topic=COLOR + "/compressed", outcome="demosaiced", error=3.0)
    color("WebP, BMP", lambda m: compressed(m, b"RIFF    WEBP", "rgb8; webp compressed "), 0,
           "its data are neither JPEG nor PNG", topic=COLOR + "/compressed")
    color("a JPEG or PNG whose format says something else",
          lambda m: compressed(m, png(rgb(m)[..., ::-1]), "jpeg"), ALL, topic=COLOR + "/compressed")
    color("rows with bytes behind them", lambda m: padded(m, 13), ALL)
    add("Color", "a first image that is damaged", lambda: first_is_empty(r), ALL - 1,
        "skipped (the image message is empty): 1", "it is skipped")
    add("Color", "of several cameras", lambda: two_cameras(r), ALL,
        "--rgb and --depth choose another camera: /camera2/rgb/image_raw",
        "the first known pair of topics, and the others are named")
    color("`hsv8`, an empty encoding", lambda m: image(m, rgb(m), ""), 0, "expected mono8, mono16, rgb8")

    depth("`16UC1`, `mono16` (mm)", lambda m: image(m, pixels(m), "mono16"), ALL)
    depth("`32FC1` (m)", lambda m: image(m, (pixels(m) / 1000.0).astype("f4"), "32FC1"), ALL)
    depth("`16UC1`, `32FC1`, the higher byte first", big_endian, ALL)
    depth("rows with bytes behind them, even an odd number", lambda m: padded(m, 13), ALL)
    depth("`64FC1`, `32SC1`, `Z16`", lambda m: image(m, pixels(m) / 1000.0, "64FC1"), 0,
          "expected 16UC1 (millimeters) or 32FC1 (meters)")
    depth("`compressedDepth`, PNG", lambda m: compressed(m, header + png(pixels(m)), "16UC1; compressedDepth png"),
          ALL, topic=DEPTH + "/compressedDepth")
    depth("`compressedDepth`, RVL", lambda m: compressed(m, header + rvl(pixels(m)), "16UC1; compressedDepth rvl"),
          ALL, topic=DEPTH + "/compressedDepth")
    depth("JPEG", lambda m: compressed(m, jpeg((pixels(m) >> 4).astype("u1")), "mono8; jpeg compressed "), 0,
          "JPEG loses depth", topic=DEPTH + "/compressed")
    depth("half the size of color, a third, a quarter",
          lambda m: image(m, pixels(m)[::2, ::2], "16UC1"), ALL, outcome="enlarged", error=2.5)
    depth("another ratio of sizes", lambda m: image(m, pixels(m)[:200], "16UC1"), 0,
          "320 x 200 pixels, but the image 320 x 240: register it")
    depth("meters as `16UC1`", lambda m: image(m, pixels(m) // 1000, "16UC1"), 0, "median depth seen 0.00",
          node_says="median depth seen 0.00")
    depth("millimeters as `32FC1`", lambda m: image(m, pixels(m).astype("f4"), "32FC1"), 0, "median depth seen")
    add("Depth", "of a camera beside color, its calibration and tf recorded",
        lambda: unregistered(r, True), ALL, "depth on /camera/depth/image_raw is registered to color here",
        "registered, what color does not see is hidden", error=4.0)
    add("Depth", "the same without its transform", lambda: unregistered(r, False), 0,
        "tf has no transform between the two")

    def set_all(**values):
        def edit(message, _number):
            for name, value in values.items():
                setattr(message, name, value)
        return edit

    def set_k(*values):
        return set_all(K=list(values))

    def model(name, *coefficients):
        return set_all(distortion_model=name, D=list(coefficients))

    def nothing(message, number):
        if number == 0:
            message.K, message.P, message.D = [0.0] * 9, [0.0] * 12, []

    info("zeros until the camera is open", nothing, ALL)
    info("zeros for ever", set_all(K=[0.0] * 9, P=[0.0] * 12), 0,
         "camera_info is not calibrated")
    info("one message at the end", lambda m, n: None if n == ALL - 1 else False, ALL)
    info("none", lambda m, n: False, 0, "no camera_info beside /camera/rgb/image_raw")
    info("a size of 0 x 0", set_all(width=0, height=0), ALL)
    info("`rational_polynomial`, 8 coefficients", model("rational_polynomial", *[0.0] * 8), ALL)
    info("`equidistant` with zeros, as wide as a pinhole", model("equidistant", *[0.0] * 4), ALL)
    info("another model with zeros", model("thin_prism", *[0.0] * 12), ALL)
    info("another model", model("thin_prism", *[0.1] * 12), 0, "expected plumb_bob, rational_polynomial or equidistant")
    info("NaN", model("plumb_bob", *[float("nan")] * 5), 0, "all numbers finite")
    info("a last row of K that is not 0 0 1", set_k(262.5, 0, 159.5, 0, 262.5, 119.5, 0, 1e-310, 0), 0,
         "K has a last row that is not 0 0 1")
    info("K of half the size", set_k(131.25, 0, 79.75, 0, 131.25, 59.75, 0, 0, 1), None,
         "is the calibration for images of 160 x 120 pixels?", "a warning")
    info("width, height and K of half the size",
         set_all(width=160, height=120, K=[131.25, 0, 79.75, 0, 131.25, 59.75, 0, 0, 1]), 0,
         "the image has 320 x 240 pixels, but the camera 160 x 120")
    info("a principal point outside", set_k(262.5, 0, 2000.0, 0, 262.5, -500.0, 0, 0, 1), 0,
         "lies outside of images of 320 x 240 pixels")
    info("focal lengths of 6 degrees, or of 179", set_k(3000.0, 0, 159.5, 0, 3000.0, 119.5, 0, 0, 1), 0, "span 6")
    info("a change by rounding", lambda m, n: setattr(m, "K", [262.5 + 1e-9 * (n % 2), 0, 159.5, 0, 262.5, 119.5,
                                                              0, 0, 1]), ALL)
    info("a true change", lambda m, n: setattr(m, "K", [262.5 - (n >= 20), 0, 159.5, 0, 262.5 - (n >= 20), 119.5,
                                                       0, 0, 1]), ALL, "the calibration has changed",
         "a new segment that begins at the last pose", error=20.0)

    stamps("zero at first", lambda s, n, t: 0.0 if n < 5 else s, 35, "left_out (stamp is zero): 5",
           "the first with a time is the first")
    stamps("zero for ever", lambda s, n, t: 0.0, 0, "all 40 stamps are 0.000000")
    stamps("doubled", lambda s, n, t: recordings.DAY + 1 + n // 2 * 2 / 30.0, 20,
           "left_out (stamp is not newer than that of the frame before): 20", "the first of each counts")
    stamps("of color doubled", lambda s, n, t: recordings.DAY + 1 + n // 2 * 2 / 30.0, 20,
           "left_out (color image without a partner within 20 ms): 20", "the first of each counts", topics=(COLOR,))
    stamps("alternating by 3 s", lambda s, n, t: s - 3.0 * (n % 2), 20,
           "left_out (stamp is not newer than that of the frame before): 20", "the later clock counts")
    stamps("a single one far ahead", lambda s, n, t: s + 1e6 * (n == 20), 39,
           "left_out (stamp is far ahead of the frames before and after it): 1", "it is left out")
    stamps("an hour later from the middle on", lambda s, n, t: s + 3600.0 * (n >= 20), ALL, error=None)
    stamps("set back in the middle", lambda s, n, t: s - 20 / 30.0 * (n >= 20), 36, "time was set back",
           "four frames later a new segment begins, and another file", error=None)
    stamps("depth 0.7 s later than color", lambda s, n, t: s + 0.7 * (t == DEPTH), 0,
           "are stamped 0.7 s apart (depth later): two clocks")
    stamps("depth 10 ms later than color", lambda s, n, t: s + 0.01 * (t == DEPTH), ALL)
    stamps("depth 15 ms later than color", lambda s, n, t: s + 0.015 * (t == DEPTH), ALL,
           "depth is stamped 15.0 ms later", "a note", node_says="depth is stamped 15.0 ms later")
    stamps("of 2105", lambda s, n, t: s - recordings.DAY + 4.29e9, ALL, error=None)
    add("Stamps", "recorded in reverse", lambda: reversed_bag(r), ALL, "recorded in another order",
        "run_bag sorts them and says so; the node leaves out what is late")

    def cut(part):
        return lambda data: data[:int(len(data) * part)]

    def flipped(data):
        for k in range(6):
            data[len(data) // 2 + k] ^= 0xff
        return data

    add("Files", "topics and frames with or without their first slash", lambda: other_slashes(r), ALL)
    add("Files", "split: several bags", lambda: split(r), ALL, outcome="as one")
    add("Files", "cut off", lambda: r.bytes_of("x.bag", cut(0.5)), 19, "(rosbag reindex ",
        "what is there, and `rosbag reindex` is named", error=3.0)
    add("Files", "without its index", lambda: r.bytes_of("x.bag", lambda data: data[:-3000]), ALL, "its index is damaged",
        "all of it, and `rosbag reindex` is named")
    add("Files", "a damaged chunk, lz4 or bz2", lambda: damaged(r, flipped), 37, "1 of its parts are damaged",
        "costs its frames")
    add("Files", "a hole in an uncompressed bag",
        lambda: r.bytes_of("x.bag", lambda d: d[:len(d) // 2] + b"\0" * 65536 + d[len(d) // 2 + 65536:]), 37,
        "1 of its parts are damaged", "costs its frames")
    add("Files", "ROS 2: `.mcap`, `.db3`, a folder", lambda: write(r, "x.mcap", b"\x89MCAP0\r\n"), 0,
        "it is a recording of ROS 2 (MCAP): convert it first")
    add("Files", "version 1 of the format", lambda: write(r, "x.bag", b"#ROSBAG V1.2\n"), 0, "rosbag fix")
    add("Files", "packed by gzip, bzip2, xz, zip, 7z, zstd or rar",
        lambda: write(r, "x.bag.gz", gzip.compress(b"#ROSBAG V2.0\n")), 0, "it is packed by gzip: unpack it first")
    add("Files", "a pipe", lambda: pipe(r), 0, "it is a pipe or a device")
    add("Files", "no bag at all, an empty file, a folder", lambda: write(r, "x.bag", b"hello\n"), 0, "it is no bag")
    return table


def write(r, name, data):
    with open(r.path(name), "wb") as file:
        file.write(data)
    return r.path(name)


def padded(message, number):
    rows = numpy.frombuffer(message.data, "u1").reshape(message.height, message.step)
    padding = numpy.full((message.height, number), 77, "u1")
    result = copy.copy(message)
    result.step, result.data = message.step + number, numpy.hstack([rows, padding]).tobytes()
    return result


def big_endian(message):
    result = image(message, pixels(message).astype(">u2"), "16UC1")
    result.is_bigendian = 1
    return result


def first_is_empty(r):
    def change(topic, message, _time, number):
        return [(topic, Image(header=message.header, encoding="rgb8"))] if topic == COLOR and number == 0 else None
    return r.change("x.bag", change)


def two_cameras(r):
    def change(topic, message, *_):
        return [(topic, message)] + [(topic.replace("camera", "camera2"), message)] * topic.startswith("/camera")
    return r.change("x.bag", change)


def other_slashes(r):
    def change(topic, message, *_):
        message = copy.deepcopy(message)
        if topic == DEPTH:
            message.header.frame_id = "/" + message.header.frame_id
        return [(topic.lstrip("/"), message)]
    return r.change("x.bag", change)


def pipe(r):
    if not os.path.exists(r.path("pipe.bag")):
        os.mkfifo(r.path("pipe.bag"))
    return r.path("pipe.bag")


def damaged(r, flip):
    path = r.change("x.bag", lambda *_: None, compression="lz4")
    with open(path, "rb") as file:
        data = bytearray(file.read())
    return write(r, "y.bag", flip(data))


def split(r):
    def part(name, first):
        def change(topic, message, _time, number):
            is_first = topic == "/tf_static" or number < 20
            if is_first != first or (topic == INFO and not first):
                return []
            return None
        return r.change(name, change)
    return [part("a_0.bag", True), part("a_1.bag", False)]


def reversed_bag(r):
    return r.change("x.bag", lambda topic, message, time, n: [
        (topic, message, genpy.Time.from_sec(2 * recordings.DAY + 4 - time.to_sec()))])


def unregistered(r, with_transform):
    """Depth as of a camera 3 cm to the left of color, with other focal lengths."""
    baseline, focal = 0.03, 240.0
    frame = "camera_depth_optical_frame"

    def seen_from_beside(array):
        """Each pixel by the nearest reading of the true image that falls on it."""
        height, width = array.shape
        v, u = numpy.mgrid[0:height, 0:width]
        z = array.astype(float)
        x = (u - 159.5) / 262.5 * z + 1000 * baseline
        y = (v - 119.5) / 262.5 * z
        with numpy.errstate(divide="ignore", invalid="ignore"):
            column = focal * x / z + 159.5
            row = focal * y / z + 119.5
        good = (z > 0) & (column > 0) & (row > 0) & (column < width - 1) & (row < height - 1)
        result = numpy.zeros_like(array)
        order = numpy.argsort(-z[good])
        result[row[good].round().astype(int)[order], column[good].round().astype(int)[order]] = \
            array[good][order]
        return result

    def change(topic, message, time, number):
        if topic == "/tf_static":
            transform = TransformStamped()
            transform.header.frame_id = "camera_rgb_optical_frame"
            transform.child_frame_id = frame
            transform.transform.translation.x = -baseline
            transform.transform.rotation.w = 1.0
            added = [("/tf_static", TFMessage([transform]))] if with_transform else []
            return [(topic, message)] + added if number == 0 else None
        if topic != DEPTH:
            return None
        beside = image(message, seen_from_beside(pixels(message)), "16UC1")
        beside.header.frame_id = frame
        calibration = calibration_of_depth(beside, focal)
        return [("/camera/depth/image_raw", beside), ("/camera/depth/camera_info", calibration)]
    return r.change("x.bag", change)


def calibration_of_depth(message, focal):
    calibration = CameraInfo(header=message.header, width=message.width, height=message.height)
    calibration.distortion_model = "plumb_bob"
    calibration.D = [0.0] * 5
    calibration.K = [focal, 0, 159.5, 0, focal, 119.5, 0, 0, 1]
    calibration.P = [focal, 0, 159.5, 0, 0, focal, 119.5, 0, 0, 0, 1, 0]
    return calibration


def error_of(r, trajectory):
    result = r.run("evaluate_trajectory", r.truth, trajectory, "--delta", "0.4", check=False)
    found = re.search(r"rpe_translation_rmse_m: (\S+)", result.stdout)
    return float(found.group(1)) if found else float("inf")


def track(r, bags):
    output = r.path("out.txt")
    result = r.run("run_bag", *bags, "--output", output, "--force", check=False)
    poses = 0
    folder, stem = os.path.dirname(output), "out"
    for name in os.listdir(folder):
        if name.startswith(stem) and name.endswith(".txt") and result.returncode == 0:
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                poses += sum(not line.startswith("#") for line in file)
    return result, poses, output


def clean(r):
    for name in os.listdir(r.folder):
        if name.startswith("out"):
            os.remove(r.path(name))


def fault_of(r, row, base_error):
    """Why a row is not so; empty: it is."""
    clean(r)
    bags = row.make()
    result, poses, output = track(r, bags if isinstance(bags, list) else [bags])
    said = result.stdout + result.stderr
    if row.says and row.says not in said:
        return "'%s' was not said, but: %s" % (row.says, said)
    if row.poses is None:
        return ""
    if poses != row.poses or (result.returncode == 0) != (row.poses > 0):
        return "%d poses instead of %d, exit code %d: %s" % (poses, row.poses, result.returncode, said)
    if row.poses == 0:
        lines = [line for line in result.stderr.splitlines() if line.startswith("run_bag: ")]
        return "" if lines and result.returncode == 1 else "no line of run_bag: " + said
    if row.error is None:
        return ""
    error = error_of(r, output)
    return "" if error < row.error * base_error else "error %g m, of the bag itself %g m" % (error, base_error)


# Rows that the node could see otherwise than run_bag does: what depends on order, time and topics.
IN_THE_NODE = ("meters as", "depth 15 ms later", "`compressedDepth`, RVL", "`yuyv`, `yuv422_yuy2`", "half the size", "of a camera beside color, its",
               "zeros until", "one message at the end", "a change by rounding", "a true change", "zero at first",
               "doubled", "of color doubled", "alternating by 3 s", "a single one far ahead", "set back in the middle",
               "of 2105", "topics and frames", "split: several bags", "cut off", "a damaged chunk")


def trajectories(folder, stem):
    """The lines of the files that a run has written, one after the other."""
    names = sorted(name for name in os.listdir(folder)
                   if name == stem + ".txt" or re.fullmatch(stem + r"_\d+\.txt", name))
    texts = []
    for name in names:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            texts.append(file.read())
    return texts


def play_command(r, bags, *arguments):
    return [os.path.join(ROOT, "test/ros/run_with_ros"), r.build, "roslaunch", "--port", "0", "mivo", "bag.launch",
            "bag:=" + " ".join(bags), "rviz:=false", "output:=" + r.path("out_node.txt"), "force:=true", "delay:=0.5",
            *arguments]


def play(r, bags, *arguments):
    """What bag.launch says."""
    return subprocess.run(play_command(r, bags, *arguments), text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False, timeout=90).stdout


def play_past_a_stopped_node(r, bags, seconds):
    """As play(), with the node standing still for longer than the bag lasts."""
    node, said = 0, []
    with subprocess.Popen(play_command(r, bags), text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT) as launch:
        for line in launch.stdout:
            said.append(line)
            started = re.search(r"process\[odometry-\d+\]: started with pid \[(\d+)\]", line)
            if started:
                node = int(started.group(1))
            if "Finished waiting for subscribers" in line:
                os.kill(node, signal.SIGSTOP)
                time.sleep(seconds)  # the fault itself: a node that stands still has nothing to wait for
                os.kill(node, signal.SIGCONT)
    return "".join(said)


def tf_fault_of(r, bag, *arguments):
    """Why no odometry was published for want of tf; empty: it was."""
    clean(r)
    said = play(r, [bag], *arguments)
    texts = trajectories(r.folder, "out_node")
    return said if not texts or texts[0].count("\n") < 10 or "no odometry is published before tf" in said else ""


def node_fault_of(r, row):
    """Why the node's poses are not those of run_bag; empty: they are."""
    clean(r)
    bags = row.make()
    bags = bags if isinstance(bags, list) else [bags]
    track(r, bags)
    expected = trajectories(r.folder, "out")
    said = play(r, bags)
    got = trajectories(r.folder, "out_node")
    if row.node_says not in said:
        return "'%s' was not said, but: %s" % (row.node_says, said)
    if got == expected:
        return ""
    count = [[text.count("\n") - 1 for text in texts] for texts in (got, expected)]
    return "poses of the node %s, of run_bag %s: %s" % (*count, said if count[0] != count[1] else "other values")


def stopped_fault_of(r, row):
    """Why messages are lost while the node stands still, as on a busy machine; empty: none is."""
    clean(r)
    bag = row.make()
    track(r, [bag])
    said = play_past_a_stopped_node(r, [bag], 2.0)
    is_same = trajectories(r.folder, "out_node") == trajectories(r.folder, "out")
    return "" if is_same else said


def table_text(table):
    lines = []
    for group in dict.fromkeys(row.group for row in table):
        lines += ["| %s | what run_bag and the node make of it |" % group, "|---|---|"]
        for row in table:
            if row.group != group:
                continue
            outcome = row.outcome or "refused: “%s”" % row.says
            lines.append("| %s | %s |" % (row.title, outcome))
        lines.append("")
    return "\n".join(lines)


def document_with(text, table):
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    return text[:begin] + "\n\n" + table_text(table) + text[end:]


def main(arguments):
    build = os.path.realpath(arguments[0])
    with tempfile.TemporaryDirectory() as folder:
        r = recordings.Recordings(build, folder, ALL)
        table = rows(r)
        with open(DOCUMENT, encoding="utf-8") as file:
            text = file.read()
        if "--write" in arguments:
            with open(DOCUMENT, "w", encoding="utf-8") as file:
                file.write(document_with(text, table))
        elif document_with(text, table) != text:
            print("doc/inputs.md is not what test/inputs/bags.py --write makes of it", file=sys.stderr)
            return 1
        if "--node" in arguments:
            table = [row for row in table if row.title.startswith(IN_THE_NODE)]
        only = [argument for argument in arguments[1:] if not argument.startswith("--")]
        _, _, output = track(r, [r.base])
        base_error = error_of(r, output)
        bad = 0
        for row in table:
            if only and not any(word in row.title for word in only):
                continue
            fault = node_fault_of(r, row) if "--node" in arguments else fault_of(r, row, base_error)
            bad += bool(fault)
            print("%s: %s: %s" % (row.group, row.title, fault or "as told"), flush=True)
        if "--node" in arguments and not only:
            without = r.change("x.bag", lambda topic, *_: [] if topic == "/tf_static" else None)
            packed = r.color("y.bag", lambda m: compressed(m, png(rgb(m)), "rgb8; png compressed rgb8"),
                             COLOR + "/compressed")
            for title, fault in (("from the middle", tf_fault_of(r, r.base, "start:=0.5")),
                                 ("without tf", tf_fault_of(r, without)),
                                 ("with its transport named", tf_fault_of(r, packed, "rgb_transport:=compressed"))):
                bad += bool(fault)
                print("played %s: %s" % (title, fault or "there is odometry"), flush=True)
            fault = stopped_fault_of(r, next(row for row in table if row.title == "one message at the end"))
            bad += bool(fault)
            print("the node stands still at the end of the bag: %s" % (fault or "no message is lost"), flush=True)
        return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
