# SPDX-License-Identifier: BSD-3-Clause
"""Tests by value of what scripts/benchmark robustness compares besides lcn."""

import os
import sys
import tempfile
import unittest

import cv2
import numpy as np

BENCHMARK = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "benchmark")
sys.path[:0] = [os.path.join(BENCHMARK, "robustness"), BENCHMARK]

import image_maps  # noqa: E402  found by the path above
import models  # noqa: E402
from measuring.keys import sequence_key  # noqa: E402
from measuring.statistics import geometric_mean, rpe  # noqa: E402

MAPS = [image_map for _, image_map, _ in models.MODELS if image_map is not None]
INDIFFERENT_TO_GAIN = [image_maps.equalized, image_maps.gain_and_bias, image_maps.rank,
                       image_maps.locally_normalized]
INDIFFERENT_TO_OFFSET = INDIFFERENT_TO_GAIN + [image_maps.local_mean_removed,
                                               image_maps.gradient_magnitude]


def gray(rows):
    return np.array(rows, np.uint8)


def textured(seed=1):
    """Between 20 and 100 gray levels, every tenth one: twice as bright, nothing is clipped."""
    return (10 * np.random.default_rng(seed).integers(2, 11, (24, 32))).astype(np.uint8)


def ramp(slope):
    return np.tile(np.arange(40, dtype=np.uint8) * slope, (30, 1))


class MapTest(unittest.TestCase):
    def agree(self, a, b):
        """Within the rounding to gray levels."""
        self.assertLessEqual(np.abs(a.astype(int) - b.astype(int)).max(), 1)

    def test_every_map_gives_a_gray_image_of_bytes(self):
        for image_map in MAPS:
            for image in (textured(), gray(np.full((24, 32), 7)), gray(np.zeros((24, 32)))):
                result = image_map(image, textured(2))
                self.assertEqual((result.dtype, result.shape), (np.uint8, image.shape))

    def test_light_that_a_map_promises_to_stand_drops_out(self):
        image, first = textured(), textured(2)
        for image_map in INDIFFERENT_TO_GAIN:
            with self.subTest(image_map.__name__):
                self.agree(image_map(2 * image + 3, first), image_map(image, first))
        for image_map in INDIFFERENT_TO_OFFSET:
            with self.subTest(image_map.__name__):
                self.agree(image_map(image + 30, first), image_map(image, first))

    def test_a_curve_that_keeps_the_order_drops_out_of_what_is_equalized(self):
        image = textured()
        curve = np.rint(255.0 * np.sqrt(np.arange(256) / 255.0)).astype(np.uint8)
        self.agree(image_maps.equalized(curve[image], image), image_maps.equalized(image, image))

    def test_equalized_by_value(self):
        # Of the two pixels that are not the darkest one is at most 20: half of the way.
        np.testing.assert_array_equal(image_maps.equalized(gray([[10, 10], [20, 30]]), None),
                                      [[0, 0], [128, 255]])

    def test_gain_and_bias_are_those_of_the_first_frame(self):
        np.testing.assert_array_equal(
            image_maps.gain_and_bias(gray([[50, 60]]), gray([[20, 100]])), [[20, 100]])

    def test_surroundings_of_the_same_mean_are_removed(self):
        result = image_maps.local_mean_removed(ramp(2), None)
        self.assertEqual(result[15, 20], 128)
        image = gray(np.full((41, 41), 50))
        image[20, 20] = 150
        # The pixel itself is a part of its surroundings, 1 / (2 pi sigma^2).
        self.assertEqual(image_maps.local_mean_removed(image, None)[20, 20],
                         round(128 + 100 * (1 - 1 / (2 * np.pi * image_maps.LOCAL_SIGMA**2))))

    def test_gradient_by_value(self):
        self.assertEqual(image_maps.gradient_magnitude(ramp(3), None)[15, 20], 12)
        self.assertEqual(image_maps.gradient_magnitude(ramp(3).T.copy(), None)[20, 15], 12)

    def test_rank_by_value(self):
        # Of the eight neighbors on a slope three are darker; on a plain none is.
        self.assertEqual(image_maps.rank(ramp(3), None)[15, 20], 3 * 28)
        self.assertEqual(image_maps.rank(gray(np.full((24, 32), 200)), None).max(), 0)

    def test_normalized_by_value(self):
        # Of the 17 columns around a bright one nine are bright and eight dark, and the deviation is
        # the same everywhere: a tenth of it is the constant.
        image = gray(np.tile([0, 100], (30, 20)))
        mean, deviation = 100 * 9 / 17, 100 * np.sqrt(72) / 17
        result = image_maps.locally_normalized(image, None)
        self.assertEqual(result[15, 21], round(128 + 55 * (100 - mean) / (1.1 * deviation)))
        self.assertEqual(result[15, 20], round(128 - 55 * (100 - mean) / (1.1 * deviation)))


class MappedSequenceTest(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.source = os.path.join(self.temporary.name, "room")
        for name in ("rgb", "depth"):
            os.makedirs(os.path.join(self.source, name))
        self.write("rgb.txt", "# stamp path\n1.0 rgb/1.png\n2.0 rgb/2.png\n")
        self.write("depth.txt", "1.0 depth/1.png\n2.0 depth/2.png\n")
        self.write("depth/1.png", "depth")
        self.write("groundtruth.txt", "1.0 0 0 0 0 0 0 1\n")
        for name, level in (("1", 0), ("2", 10)):
            image = np.repeat((textured() + level)[:, :, None], 3, 2)
            cv2.imwrite(os.path.join(self.source, "rgb", name + ".png"), image)

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, name, text):
        with open(os.path.join(self.source, name), "w", encoding="utf-8") as file:
            file.write(text)

    def mapped(self):
        return image_maps.mapped(os.path.join(self.temporary.name, "mapped"), self.source,
                                 image_maps.gain_and_bias)

    def test_images_are_mapped_and_the_rest_is_the_same(self):
        folder = self.mapped()
        for name in ("1", "2"):  # the second is as bright as the first again
            image = cv2.imread(os.path.join(folder, "rgb", name + ".png"), cv2.IMREAD_UNCHANGED)
            np.testing.assert_array_equal(image, textured())
        for name in ("rgb.txt", "groundtruth.txt", "depth/1.png"):
            with open(os.path.join(folder, name), encoding="utf-8") as ours, \
                    open(os.path.join(self.source, name), encoding="utf-8") as theirs:
                self.assertEqual(ours.read(), theirs.read())

    def test_they_are_mapped_once_unless_the_source_changes(self):
        first = sequence_key(self.mapped())
        image = os.path.join(self.mapped(), "rgb", "1.png")
        written = os.stat(image).st_mtime_ns
        self.assertEqual(os.stat(os.path.join(self.mapped(), "rgb", "1.png")).st_mtime_ns, written)
        self.write("groundtruth.txt", "1.0 1 0 0 0 0 0 1\n")
        self.assertNotEqual(sequence_key(self.mapped()), first)
        self.assertTrue(os.path.exists(os.path.join(self.source, "depth", "1.png")))


class TableTest(unittest.TestCase):
    def test_a_model_is_summed_up_over_lights_and_sequences(self):
        runs = [models.Run("filmed", name, "room", *rest)
                for name in ("a", "b")
                for rest in (("constant", 0.001, 0.1, 0), ("ramp_step", 0.002, 0.4, 1),
                             ("moving_lamp", 0.008, 0.1, 2))]
        self.assertEqual(models.rows_of(runs), [
            [name, "0.0010 0.100", "0.0040 0.200", "0.0080 0.100 room moving_lamp", "3"]
            for name in ("a", "b")])

    def test_names_and_maps_are_told_apart(self):
        names = [name for name, _, _ in models.MODELS]
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(len({image_map.__name__ for image_map in MAPS}), len(MAPS))

    def test_figures(self):
        self.assertAlmostEqual(geometric_mean([1.0, 4.0]), 2.0)
        self.assertEqual(rpe({"rpe_translation_rmse_m": "0.5", "rpe_rotation_rmse_deg": "2"}),
                         (0.5, 2.0))


if __name__ == "__main__":
    unittest.main()
