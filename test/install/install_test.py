#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a user gets from `cmake --install`: programs that run from the prefix, a CMake package that the
examples build with, and, with ROS, what rosrun and roslaunch find. Without LD_LIBRARY_PATH.

    install_test.py BUILD_FOLDER SEQUENCE_FOLDER [--without-ros]
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
PLOTS = {"plot_evaluation"}
ROS_SCRIPTS = {"mivo_top", "play_bag", "plot_bag"}
PROGRAMS = {"evaluate_trajectory", "generate_sequence", "relight_sequence", "run_sequence"}
ROS_PROGRAMS = {"bag_to_sequence", "check_bag", "odometry_node", "openni2_node", "run_bag", "sequence_to_bag"}
EXPECT_FOUND = os.path.join(ROOT, "test", "install", "expect_found.py")
EXAMPLES = ("1_track_folder", "2_track_images", "3_align_two_frames")
PRIVATE_VARIABLES = ("LD_LIBRARY_PATH", "CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH")


def environment():
    """Of a user who has sourced nothing."""
    return {name: value for name, value in os.environ.items() if name not in PRIVATE_VARIABLES}


def run(*command, expected=0, **options):
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            env=environment(), check=False, timeout=300, **options)
    if result.returncode != expected:
        raise AssertionError("%s ended with %d:\n%s" % (" ".join(command), result.returncode,
                                                        result.stdout[-4000:]))
    return result.stdout


def sourced(setup, command):
    return run("bash", "-c", ". '%s' && %s" % (setup, command))


class InstallTest(unittest.TestCase):
    build = sequence = None
    with_ros = True

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="mivo_install_")
        cls.prefix = os.path.join(cls.folder, "prefix")
        run("cmake", "--install", cls.build, "--prefix", cls.prefix)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def programs(self):
        return PROGRAMS | (ROS_PROGRAMS if self.with_ros else set())

    def test_programs_are_installed_and_run(self):
        folder = os.path.join(self.prefix, "lib/mivo")
        scripts = PLOTS | (ROS_SCRIPTS if self.with_ros else set())
        self.assertEqual(self.programs() | scripts, set(os.listdir(folder)))
        for name in sorted(self.programs()):
            libraries = run("ldd", os.path.join(folder, name))
            self.assertNotIn("not found", libraries, name)
            self.assertNotIn(self.build, libraries, name)
        for name in sorted(PROGRAMS | ({"run_bag"} if self.with_ros else set())):
            self.assertIn("Usage: " + name, run(os.path.join(folder, name), "--help"))

    def test_nothing_points_to_the_build_folder(self):
        for folder, _, names in os.walk(self.prefix):
            for name in names:
                if not name.endswith((".cmake", ".pc", ".sh", ".xml", ".launch", ".py")):
                    continue
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    self.assertNotIn(self.build + "/", file.read(), name)

    def test_public_headers_alone_are_installed(self):
        installed = {os.path.relpath(os.path.join(folder, name), self.prefix)
                     for folder, _, names in os.walk(os.path.join(self.prefix, "include/mivo"))
                     for name in names}
        public = {os.path.relpath(os.path.join(folder, name), ROOT)
                  for folder, _, names in os.walk(os.path.join(ROOT, "include/mivo"))
                  for name in names}
        self.assertLessEqual(public, installed)
        made = {name for name in installed - public if os.path.dirname(name) == "include/mivo"}
        self.assertEqual(public | made, installed)  # those made from messages
        self.assertEqual(self.with_ros, bool(made))

    def test_examples_are_built_and_run(self):
        build = os.path.join(self.folder, "examples")
        run("cmake", "-S", os.path.join(ROOT, "examples"), "-B", build,
            "-DCMAKE_PREFIX_PATH=" + self.prefix, "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror",
            "-DPython3_EXECUTABLE=" + sys.executable, "-DPYTHON_EXECUTABLE=" + sys.executable)
        run("cmake", "--build", build)
        for name in EXAMPLES:
            with open(os.path.join(ROOT, "examples", name + ".cpp"), encoding="utf-8") as file:
                self.assertLess(len(file.readlines()), 60, name)
            run(os.path.join(build, name), expected=2)  # says how it is used
        self.check_tracking_of_a_folder(build)
        self.check_tracking_of_images(build)
        self.check_alignment(build)

    def check_tracking_of_a_folder(self, build):
        output = os.path.join(self.folder, "example.txt")
        said = run(os.path.join(build, EXAMPLES[0]), self.sequence, output)
        frames = self.numbers_of_frames()
        self.assertIn("%d of %d frames tracked" % (frames, frames), said)
        report = run(os.path.join(self.prefix, "lib/mivo/evaluate_trajectory"),
                     os.path.join(self.sequence, "groundtruth.txt"), output, "--delta", "0.1")
        error = float(re.search(r"^ate_rmse_m: (\S+)$", report, re.MULTILINE).group(1))
        self.assertLess(error, 0.003)
        self.assertIn("no such", run(os.path.join(build, EXAMPLES[0]), "/no such", output, expected=1))

    def check_tracking_of_images(self, build):
        with open(os.path.join(self.sequence, "camera.txt"), encoding="utf-8") as file:
            line = [line for line in file if not line.startswith("#")][0].split()
        images = os.path.join(self.folder, "images")
        shutil.copytree(self.sequence, images)
        dark = sorted(os.listdir(os.path.join(images, "rgb")))[4]
        run(sys.executable, "-c", "import cv2, sys; image = cv2.imread(sys.argv[1]); "
            "cv2.imwrite(sys.argv[1], image[:200])", os.path.join(images, "rgb", dark))
        said = run(os.path.join(build, EXAMPLES[1]), os.path.join(images, "rgb"),
                   os.path.join(images, "depth"), *line[2:6]).splitlines()
        self.assertEqual(self.numbers_of_frames(), len(said))
        self.assertIn("frame does not match the camera", said[4])  # of another size: reported, the rest goes on
        for line in said[:4] + said[5:]:
            self.assertRegex(line, r"^\d+ tracking segment \d+ at +\S+ +\S+ +\S+ m, sigma \S+ m \S+ rad$")
            self.assertLess(float(line.split()[-4]), 0.01)

    def check_alignment(self, build):
        residual = os.path.join(self.folder, "residual.png")
        said = run(os.path.join(build, EXAMPLES[2]), self.sequence, "0", "2", residual)
        self.assertRegex(said, r"^tracking: translation ")
        self.assertLess(float(re.search(r"mean difference (\S+)", said).group(1)), 10.0)
        self.assertGreater(float(re.search(r"mean difference (\S+)", said).group(1)), 0.0)
        self.assertGreater(os.path.getsize(residual), 1000)

    def numbers_of_frames(self):
        with open(os.path.join(self.sequence, "rgb.txt"), encoding="utf-8") as file:
            return sum(not line.startswith("#") for line in file)

    def test_ros_tools_find_everything(self):
        if not self.with_ros:
            self.skipTest("built without ROS")
        bag = os.path.join(self.folder, "found.bag")
        run(os.path.join(self.prefix, "lib/mivo/sequence_to_bag"), self.sequence, bag, "--layout", "openni2")
        folder = os.path.join(self.prefix, "lib/mivo")
        installed = sum(os.access(os.path.join(folder, name), os.X_OK) for name in os.listdir(folder))
        for space in (os.path.join(self.build, "devel"), self.prefix):
            setup = os.path.join(space, "setup.bash")
            said = sourced(setup, "'%s' '%s' '%s'" % (sys.executable, EXPECT_FOUND, bag))
            self.assertIn(" %d programs, " % installed, said)
            self.assertIn("bag to play (required)", sourced(setup, "roslaunch --ros-args mivo bag.launch"))
            plugins = sourced(setup, "rospack plugins --attrib=plugin nodelet")
            self.assertRegex(plugins, r"mivo \S*/nodelet_plugins.xml")

    def test_a_bag_is_played_from_the_prefix(self):
        if not self.with_ros:
            self.skipTest("built without ROS")
        bag = os.path.join(self.folder, "sequence.bag")
        output = os.path.join(self.folder, "node.txt")
        run(os.path.join(self.prefix, "lib/mivo/sequence_to_bag"), self.sequence, bag,
            "--layout", "openni2")
        port = run(sys.executable, "-c", "import socket; s = socket.socket(); s.bind(('', 0)); "
                   "print(s.getsockname()[1])").strip()
        sourced(os.path.join(self.prefix, "setup.bash"),
                "export ROS_HOME='%s' ROS_HOSTNAME=localhost ROS_MASTER_URI=http://localhost:%s && "
                "timeout 60 roslaunch -p %s mivo bag.launch bag:='%s' rviz:=false output:='%s' "
                "more_topics:=/ground_truth"  # nobody listens to it, nobody is waited for
                % (self.folder, port, port, bag, output))
        direct = os.path.join(self.folder, "direct.txt")
        run(os.path.join(self.prefix, "lib/mivo/run_bag"), bag, "--output", direct)
        with open(output, encoding="utf-8") as node, open(direct, encoding="utf-8") as program:
            self.assertEqual(program.read(), node.read())


if __name__ == "__main__":
    if "--without-ros" in sys.argv:
        sys.argv.remove("--without-ros")
        InstallTest.with_ros = False
    InstallTest.build, InstallTest.sequence = map(os.path.realpath, sys.argv[1:3])
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
