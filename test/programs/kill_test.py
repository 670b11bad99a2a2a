# SPDX-License-Identifier: BSD-3-Clause
"""What a run leaves behind that is killed, or whose disk is full: whole lines up to there.

    kill_test.py PROGRAM_FOLDER [KILLS]
"""
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "inputs"))
try:
    from sequence import FRAMES, Folder
except ImportError:
    print("skipped: python3-opencv or python3-numpy is missing")
    sys.exit(77)

KILLS = int(sys.argv.pop()) if len(sys.argv) > 2 else 5
RUN_SEQUENCE = os.path.join(sys.argv.pop(), "run_sequence")
SEED = 28


def whole_lines(path):
    """The lines of a file, whose last one must be as whole as the others."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if text and not text.endswith("\n"):
        raise AssertionError("%s ends within a line: %r" % (path, text[-80:]))
    return text.splitlines()


class KillTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.sequence = os.path.join(cls.folder.name, "sequence")
        Folder(cls.sequence).plain()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def command(self):
        self.trajectory = os.path.join(self.folder.name, "trajectory.txt")
        self.statistics = os.path.join(self.folder.name, "statistics.csv")
        for path in (self.trajectory, self.statistics):
            if os.path.exists(path):
                os.remove(path)
        return [RUN_SEQUENCE, self.sequence, "--output", self.trajectory, "--statistics",
                self.statistics]

    def check(self, least):
        """Both files are readable, with at least so many frames."""
        poses = [line for line in whole_lines(self.trajectory) if not line.startswith("#")]
        self.assertGreaterEqual(len(poses), least)
        for pose in poses:
            self.assertEqual(8, len([float(number) for number in pose.split()]))
        rows = whole_lines(self.statistics)
        # Written after the pose of the frame, whose end may lie between the two.
        self.assertGreaterEqual(len(rows), least)
        for row in rows:
            self.assertEqual(len(rows[0].split(",")), len(row.split(",")))
        return len(poses)

    def test_a_killed_run_leaves_every_frame_up_to_there(self):
        choose = random.Random(SEED)
        for _ in range(KILLS):
            frames = choose.randint(1, FRAMES - 4)
            process = subprocess.Popen(self.command(), stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            while process.poll() is None:  # until so many frames are written
                if os.path.exists(self.trajectory):
                    with open(self.trajectory, encoding="utf-8") as file:
                        if file.read().count("\n") > frames:
                            break
            process.send_signal(signal.SIGKILL)
            process.wait()
            self.check(frames)

    def test_a_full_disk_is_an_error_and_leaves_whole_lines(self):
        subprocess.run(self.command(), stdout=subprocess.DEVNULL, check=True)
        size = os.path.getsize(self.trajectory)
        frames = self.check(FRAMES - 2)
        for limit in (size // 2, size - 1):

            def fill_disk(limit=limit):
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # the write fails instead
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

            command = self.command()[:4]  # the statistics are larger
            result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                    preexec_fn=fill_disk, universal_newlines=True, check=False)
            self.assertEqual(1, result.returncode)
            self.assertIn("cannot write " + self.trajectory, result.stderr)
            lines = whole_lines(self.trajectory)
            self.assertLess(len(lines) - 1, frames)
            self.assertGreater(os.path.getsize(self.trajectory), limit - 150)  # a line at most


if __name__ == "__main__":
    unittest.main()
