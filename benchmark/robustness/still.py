# SPDX-License-Identifier: BSD-3-Clause
"""A camera at rest."""

import numpy as np

from measuring.trajectories import difference, read_trajectory


def static(bench):
    """Table III: one real or filmed frame relit, every frame from a disturbed start."""
    rows = []
    for scene, seed in bench.scenes:
        for kind, light_name in (("S1", "ramp_step"), ("S2", "moving_lamp")):
            folder = bench.filmed(scene, seed, "static", light_name)
            cells = []
            for method in bench.trackers():
                figures = bench.run(method, folder, "--reference", "first", "--disturb", 0.005,
                                    0.005, "--seed", 1)
                _, poses = read_trajectory(figures["base"] + ".txt")
                sizes = np.array([difference(np.eye(4), np.eye(4), poses[0], pose)
                                  for pose in poses[1:]])
                cells.append("{:.3f} mm {:.3f} mrad".format(*(1e3 * np.median(sizes, axis=0))))
            rows.append([f"{scene}{seed}", kind] + cells)
    bench.say_table("Static, disturbed starts: median error", ["scene", "light"] + bench.trackers(),
                    rows)


def rest(bench):
    """RMS deviation from the mean."""
    rows = []
    for scene, seed in bench.scenes:
        for lamps in ("constant", "oscillating"):
            folder = bench.filmed(scene, seed, "static", lamps)
            figures = bench.run("mivo", folder)
            _, poses = read_trajectory(figures["base"] + ".txt")
            positions = poses[:, :3, 3]
            rms = np.sqrt(np.mean(np.sum((positions - positions.mean(axis=0))**2, axis=1)))
            angles = [difference(np.eye(4), np.eye(4), poses[len(poses) // 2], pose)[1]
                      for pose in poses]
            rows.append([f"{scene}{seed}", lamps, f"{1e3 * rms:.3f}",
                         f"{np.degrees(np.sqrt(np.mean(np.square(angles)))):.4f}",
                         bench.wrong(figures, folder)])
    bench.say_table("Camera at rest",
                    ["scene", "light", "rms mm", "rms deg", "undetected errors"], rows)
