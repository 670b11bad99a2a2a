#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks README.md and doc/*.md against the repository:

  - relative links resolve, and so do their anchors;
  - parameters and options that are named exist;
  - messages quoted in doc/troubleshooting.md exist in the sources, and every warning and error that
    the nodes log is explained there;
  - the README answers what a stranger asks first;
  - the README's tables agree with doc/robustness.md and doc/speed.md.

    test/docs_test.py
"""

import glob
import os
import re
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "config"))
from parameter_table import read_parameters  # noqa: E402, found by the line above

# What a stranger asks first, and words of the answer.
QUESTIONS = {
    "What frame is the pose in?": ("optical frame", "`base_frame`"),
    "What is the covariance of?": ("translation (m) before rotation (rad)", "`nav_msgs/Odometry`"),
    "What does lost look like?": ("LOST", "`result.isMeasured()`", "`lost_frames`"),
    "Which topic names does a RealSense have?": ("/camera/aligned_depth_to_color/image_raw",),
    "How do I record?": ("record.launch", "rosbag record"),
    "How do I compare with ground truth?": ("`evaluate_trajectory GROUNDTRUTH TRAJECTORY",),
    "How do I use it without ROS?": ("-DMIVO_WITH_ROS=OFF",),
    "How do I use it on a robot that has wheel odometry?": ("`publish_tf:=false`", "`guess_frame_id:="),
}

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
SETTING = re.compile(r"--set[ =]([a-z_]+)=")
PARAMETER_ROW = re.compile(r"^\| ((?:`[a-z_0-9]+`(?:, )?)+)")
STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
LOGGED = re.compile(r'ROS_(?:WARN|ERROR)\w*\(((?:"(?:[^"\\\n]|\\.)*"|[^;"])*)')


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def documents():
    return ["README.md"] + sorted(os.path.relpath(path, ROOT)
                                  for path in glob.glob(os.path.join(ROOT, "doc", "*.md")))


def anchors(text):
    """Anchors of the headings, as GitHub forms them."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", FENCE.sub("", text), re.MULTILINE):
        words = re.sub(r"[^\w\- ]", "", heading.lower())
        found.add(words.strip().replace(" ", "-"))
    return found


def tracker_parameters():
    return {parameter.name for parameter in read_parameters()}


def node_parameters():
    """Names that the nodes read from the parameter server."""
    return set(re.findall(r'visitor\("(\w+)"', read("src/ros/node_parameters.cpp")) +
               re.findall(r'readParameter\(node, "(\w+)"', read("src/ros/camera_parameters.cpp")))


def sources():
    for pattern in ("src/**/*.cpp", "src/**/*.h", "include/**/*.h", "src/ros/play_bag", "launch/*"):
        for path in sorted(glob.glob(os.path.join(ROOT, pattern), recursive=True)):
            yield os.path.relpath(path, ROOT)


def literals(text):
    """All string literals, adjacent ones joined; what stands between two of them becomes a gap."""
    parts = []
    end = None
    for match in STRING.finditer(re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE)):
        between = "" if end is None else match.string[end:match.start()]
        parts += [("" if not between.strip() else "\0"), match.group(1)]
        end = match.end()
    return "".join(parts)


def fragments(message):
    """The fixed parts of a message, in which … stands for a value."""
    return [part.strip() for part in message.split("…") if len(part.strip()) > 2]


class Docs(unittest.TestCase):
    def test_links_resolve(self):
        for document in documents():
            text = FENCE.sub("", read(document))
            for target in LINK.findall(text):
                if re.match(r"[a-z]+:", target):
                    continue
                path, _, anchor = target.partition("#")
                full = os.path.normpath(os.path.join(ROOT, os.path.dirname(document), path)) \
                    if path else os.path.join(ROOT, document)
                with self.subTest(document=document, link=target):
                    self.assertTrue(os.path.exists(full), "no such file")
                    if anchor:
                        self.assertIn(anchor, anchors(read(os.path.relpath(full, ROOT))))

    def test_settings_exist(self):
        known = tracker_parameters()
        for document in documents():
            for name in set(SETTING.findall(read(document))) - {"name"}:
                with self.subTest(document=document):
                    self.assertIn(name, known)

    def test_parameters_of_tuning_exist(self):
        """Every `name` with an underscore in tuning.md is a parameter or known from elsewhere."""
        known = tracker_parameters() | node_parameters()
        elsewhere = read("msg/TrackingStatus.msg") + read("src/programs/tracking_summary.cpp")
        for name in set(re.findall(r"`([a-z]+_[a-z_]+)`", read("doc/tuning.md"))):
            with self.subTest(name=name):
                self.assertTrue(name in known or name in elsewhere or
                                name in ("run_sequence", "camera_info"), "no such parameter")

    def test_tables_of_node_parameters_are_complete(self):
        listed = set()
        for document in ("doc/ros.md", "doc/xtion.md"):
            _, _, section = read(document).partition("\n## Parameters\n")
            for line in section.partition("\n## ")[0].splitlines():
                match = PARAMETER_ROW.match(line)
                if match:
                    listed |= set(re.findall(r"`(\w+)`", match.group(1)))
        self.assertEqual(listed, node_parameters())

    def test_quoted_messages_exist(self):
        said = "\0".join(literals(read(path)) for path in sources())
        said = said.replace("\\n", " ").replace('\\"', '"')
        said = re.sub(r"%[-.0-9]*(?:lu|zu|[a-z])|\{[^}]*\}", "\0", said)
        for line in read("doc/troubleshooting.md").splitlines():
            if not line.startswith("| `"):
                continue
            for message in re.findall(r"`([^`]+)`", line.split(" | ")[0]):
                for fragment in fragments(message):
                    with self.subTest(message=message):
                        self.assertIn(fragment, said)

    def test_logged_messages_are_explained(self):
        explained = [fragments(message) for message in
                     re.findall(r"`([^`]+)`", read("doc/troubleshooting.md"))]
        for path in sorted(glob.glob(os.path.join(ROOT, "src/ros/*.cpp"))):
            text = read(path)
            for match in LOGGED.finditer(text):
                logged = literals(match.group(1))
                if not re.search(r"[a-z]{3}", logged):
                    continue  # only passes on the text of an exception
                logged = re.sub(r"%[-.0-9]*(?:lu|zu|[a-z])|\{[^}]*\}", "\0", logged)
                with self.subTest(message=logged, file=os.path.basename(path)):
                    self.assertTrue(any(parts and all(part in logged for part in parts)
                                        for parts in explained), "not in doc/troubleshooting.md")

    def test_the_first_questions_are_answered(self):
        answers = dict(re.findall(r"^\*\*([^*]+\?)\*\*(.*?)(?=^\*\*|^## )", read("README.md"),
                                  re.MULTILINE | re.DOTALL))
        for question, words in QUESTIONS.items():
            for word in words:
                with self.subTest(question=question, word=word):
                    self.assertIn(word, answers.get(question, ""))

    def test_tables_of_the_readme_agree(self):
        for document, width, columns in (("doc/robustness.md", 9, (2, 3, 6, 7)),
                                         ("doc/speed.md", 8, (4, 3, 5, 7))):
            # cells by the first ones of a row, in the order of the README's table
            rows = {}
            for line in read(document).splitlines():
                cells = [cell.strip() for cell in line.strip("|").split("|")]
                if len(cells) == width:
                    names = 2 if document == "doc/robustness.md" else 1
                    rows.setdefault(tuple(cells[:names]), [cells[column] for column in columns])
            found = 0
            for line in read("README.md").splitlines():
                cells = [cell.strip() for cell in line.strip("|").split("|")]
                for names in (1, 2):
                    key = tuple(cells[:names])
                    if key in rows and len(cells) == names + 4 and len(cells[-1]) > 2 \
                            and cells[-1][0].isdigit():
                        found += 1
                        with self.subTest(row=key, document=document):
                            self.assertEqual(cells[names:], rows[key])
            self.assertGreater(found, 2, "no row of " + document + " in README.md")


if __name__ == "__main__":
    unittest.main()
