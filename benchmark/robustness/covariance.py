# SPDX-License-Identifier: BSD-3-Clause
"""NEES: error of each pose, relative to the true first one, over its reported covariance."""

import numpy as np

from judging import nees
from measuring.tracks import read_frames


def covariance(bench):
    rows, every = [], []
    for scene, seed in bench.scenes:
        for path in bench.paths:
            folder = bench.filmed(scene, seed, path, "constant")
            figures = bench.run("mivo", folder)
            ratios = nees(read_frames(figures["base"], folder))
            every += ratios
            rows.append([f"{scene}{seed} {path}"] + summary(ratios) + [bench.wrong(figures, folder)])
    rows.append(["all"] + summary(every) + [""])
    bench.say_table("Covariance: NEES / 6",
                    ["sequence", "mean", "median", "95 %", "undetected errors"], rows)


def summary(ratios):
    return [f"{np.mean(ratios):.2f}", f"{np.median(ratios):.2f}", f"{np.quantile(ratios, 0.95):.2f}"]
