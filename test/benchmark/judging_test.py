# SPDX-License-Identifier: BSD-3-Clause
"""Tests by value of how scripts/benchmark robustness judges what is said of poses."""

import os
import sys
import tempfile
import unittest

import numpy as np
from PIL import Image

BENCHMARK = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "benchmark")
sys.path[:0] = [os.path.join(BENCHMARK, "robustness"), BENCHMARK]

import degenerate  # noqa: E402  found by the path above
import events  # noqa: E402
import gaps  # noqa: E402
import judging  # noqa: E402
import sparse  # noqa: E402
from measuring.tracks import Frame, measured, read_frames  # noqa: E402
from measuring.trajectories import exp_so3, size, vector_of  # noqa: E402
from open_motions import open_motions, seen_error, small_motion  # noqa: E402

SIGMA_M, SIGMA_RAD = 1e-3, 1e-4


def at(x=0.0, yaw=0.0, y=0.0, z=0.0):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    pose[:3, :3] = exp_so3(np.array([0.0, 0.0, yaw]))
    return pose


def statistics(keyframe=1, new_keyframe=0.0, sigma_m=SIGMA_M, sigma_rad=SIGMA_RAD):
    row = {"keyframe": float(keyframe), "new_keyframe": new_keyframe}
    for name in ("covariance", "alignment_covariance"):
        for i in range(6):
            for j in range(i, 6):
                row[f"{name}_{i}{j}"] = (i == j) * (sigma_m if i < 3 else sigma_rad)**2
    return row


def frame(number, pose, truth, state="tracking", segment=0, **options):
    return Frame(number / 30.0, state, segment, statistics(**options), pose, truth)


def sliding(errors_m, **options):
    """A camera that moves by 1 cm a frame, estimated with these errors."""
    return [frame(i, at(0.01 * i + error), at(0.01 * i), **options)
            for i, error in enumerate(errors_m)]


class WrongMotionTest(unittest.TestCase):
    def numbers(self, frames, is_recording=False):
        return [frames.index(wrong) for wrong in judging.wrong_motions(frames, is_recording)]

    def test_a_jump_and_the_way_back_are_wrong(self):
        # Both frames' millimeter makes 1.4 mm: five of them are 7.1 mm.
        self.assertEqual(self.numbers(sliding([0.0, 0.0, 0.009, 0.0, 0.0])), [2, 3])

    def test_what_is_wrong_within_its_claim_or_small_is_not(self):
        self.assertEqual(self.numbers(sliding([0.0, 0.0, 0.006, 0.0])), [])
        self.assertEqual(self.numbers(sliding([0.0, 0.0, 0.003, 0.0], sigma_m=1e-5)), [])
        self.assertEqual(self.numbers(sliding([0.0, 0.0, 0.0035, 0.0], sigma_m=1e-5)), [2, 3])

    def test_a_share_of_the_motion_is_granted(self):
        frames = [frame(0, at(0.0), at(0.0), sigma_m=1e-5), frame(1, at(0.51), at(0.5), sigma_m=1e-5)]
        self.assertEqual(self.numbers(frames), [])

    def test_rotations_count_too(self):
        frames = [frame(0, at(), at()), frame(1, at(yaw=np.radians(0.12)), at())]
        self.assertEqual(self.numbers(frames), [1])

    def test_what_is_not_called_tracking_is_not_wrong(self):
        frames = sliding([0.0, 0.0, 0.009])
        frames[2] = frames[2]._replace(state="degraded")
        self.assertEqual(self.numbers(frames), [])
        frames[2] = frames[2]._replace(state="tracking", segment=1)
        self.assertEqual(self.numbers(frames), [])

    def test_lost_frames_are_left_out_between(self):
        frames = sliding([0.0, 0.0, 0.5, 0.0])
        frames[2] = frames[2]._replace(state="lost")
        self.assertEqual(self.numbers(frames), [])

    def test_the_truth_of_a_recording_errs(self):
        frames = sliding([0.0, 0.008, 0.0, 0.008, 0.0, 0.008, 0.0])
        self.assertEqual(self.numbers(frames), [1, 2, 3, 4, 5, 6])
        self.assertEqual(self.numbers(frames, is_recording=True), [])

    def test_far_from_the_keyframe(self):
        frames = sliding([0.0, 0.05, 0.2])
        frames[0] = frames[0]._replace(row=statistics(keyframe=0, new_keyframe=1.0))
        self.assertEqual(judging.far_wrong(frames), [frames[2]])


class FalseLossTest(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        random = np.random.default_rng(1)
        self.lit = self.write("lit.png", random.integers(0, 255, (8, 8), dtype=np.uint8))
        self.dark = self.write("dark.png", random.integers(0, 3, (8, 8), dtype=np.uint8))

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, name, pixels):
        path = os.path.join(self.temporary.name, name)
        Image.fromarray(pixels).save(path)
        return path

    def frames(self, jump):
        """Frame 6 of 12 is lost; the camera moves by 1 cm a frame, and `jump` more around it."""
        frames = [frame(i, at(0.01 * i + (jump if i > 6 else 0.0)), None) for i in range(12)]
        frames[6] = frames[6]._replace(state="lost")
        return frames

    def count(self, frames, image):
        return len(judging.false_losses(frames, lambda stamp: image))

    def test_an_ordinary_motion_between_lit_frames(self):
        self.assertEqual(self.count(self.frames(0.0), self.lit), 1)
        self.assertEqual(self.count(self.frames(0.035), self.lit), 1)

    def test_an_unusual_motion_is_a_reason(self):
        self.assertEqual(self.count(self.frames(0.05), self.lit), 0)

    def test_darkness_is_a_reason(self):
        self.assertEqual(self.count(self.frames(0.0), self.dark), 0)

    def test_one_that_was_not_found_again_is_not_known(self):
        frames = self.frames(0.0)
        self.assertEqual(self.count(frames[:7], self.lit), 0)
        changed = [one._replace(segment=int(i > 6)) for i, one in enumerate(frames)]
        self.assertEqual(self.count(changed, self.lit), 0)


class OpenMotionTest(unittest.TestCase):
    def test_what_is_open_is_taken_out_and_the_rest_stays(self):
        pose = small_motion(np.array([0.3, -0.2, 0.5, 0.4, -0.1, 0.2]))
        for scene in ("stripes", "blank", "tube", "rings", "floor", "blank_floor",
                      "blank_after_texture"):
            motions = open_motions(scene, 2)
            for amounts in (0.3, -0.2):
                world = small_motion(motions @ np.full(motions.shape[1], amounts))
                error = np.linalg.inv(pose) @ world @ pose  # of the pose moved along what is open
                self.assertGreater(max(size(error)), 0.1)
                self.assertLess(max(size(seen_error(error, pose, motions))), 1e-6, scene)
        across = np.linalg.inv(pose) @ at(y=0.02) @ pose
        np.testing.assert_allclose(size(seen_error(across, pose, open_motions("stripes", 1))),
                                   (0.02, 0.0), atol=1e-9)

    def test_a_small_motion_is_a_screw(self):
        turned = small_motion(np.array([np.pi / 2.0, 0.0, 0.0, 0.0, 0.0, np.pi / 2.0]))
        np.testing.assert_allclose(turned, at(1.0, np.pi / 2.0, 1.0), atol=1e-12)
        np.testing.assert_allclose(vector_of(small_motion(np.array([0, 0, 0, 0.1, 0.2, 0.3])))[3:],
                                   [0.1, 0.2, 0.3], atol=1e-12)

    def test_a_row_of_the_table(self):
        frames = [frame(0, at(), at()), frame(1, at(z=0.1), at()),
                  frame(2, at(y=0.002), at(), state="degraded"), frame(3, None, at(), state="lost")]
        judged = degenerate.judge(frames, "stripes", 1)
        # One is far off along the stripes, which is 100 sigma; the other two sigma beside.
        self.assertEqual(degenerate.summary([judged]),
                         ["2", "1", "1", "0", "1", "50.0 %", "833.67", "1.00 0.000", "1.90 0.000"])


class GapTest(unittest.TestCase):
    def test_the_farthest_guess(self):
        good = frame(0, at(), None)
        frames = [frame(1, at(0.3), None), frame(2, at(0.5), None, state="lost"),
                  frame(3, None, None, state="initializing"), frame(4, at(0.9), None, segment=1),
                  frame(5, at(4.0), None, segment=1)]
        self.assertAlmostEqual(gaps.farthest(good, frames), 0.6)

    def test_stamps_jump_by_the_gap(self):
        with tempfile.TemporaryDirectory() as folder:
            events.write_lists(folder, [("c", "d", ["0"] * 7)] * 3, period=0.1, gap=(2, 60.0))
            with open(os.path.join(folder, "rgb.txt"), encoding="utf-8") as file:
                stamps = [float(line.split()[0]) for line in file]
        np.testing.assert_allclose(stamps, [1000.0, 1000.1, 1060.2])


class TrackTest(unittest.TestCase):
    def test_poses_and_statistics_belong_together_by_stamp(self):
        with tempfile.TemporaryDirectory() as folder:
            def write(name, text):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            write("run.csv", "stamp,state,segment\n1.000000,initializing,0\n1.100000,tracking,0\n"
                             "1.200000,lost,0\n1.300000,degraded,0\n")
            write("run.txt", "# stamp\n1.100000 1 0 0 0 0 0 1\n1.300000 3 0 0 0 0 0 1\n")
            write("groundtruth.txt", "1.05 0 0 0 0 0 0 1\n1.15 2 0 0 0 0 0 1\n1.3 9 0 0 0 0 0 1\n")
            frames = read_frames(os.path.join(folder, "run"), folder)
            self.assertEqual([one.state for one in measured(frames)], ["tracking", "degraded"])
            self.assertEqual([one.pose is None for one in frames], [True, False, True, False])
            self.assertEqual(frames[3].pose[0, 3], 3.0)
            # True poses lie between their neighbors, unless these are far apart.
            self.assertAlmostEqual(frames[1].truth[0, 3], 1.0)
            self.assertEqual([one.truth is None for one in frames], [True, False, True, False])
            write("run.txt", "# nothing was tracked\n")
            self.assertEqual(measured(read_frames(os.path.join(folder, "run"), folder)), [])

    def test_paces_cover_the_range(self):
        paces = [sparse.pace(seed) for seed in sparse.SEEDS]
        self.assertLess(min(paces), 0.35)
        self.assertGreater(max(paces), 2.1)


if __name__ == "__main__":
    unittest.main()
