# SPDX-License-Identifier: BSD-3-Clause
"""Plots of what was measured."""

import os

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  after the choice of the backend
from matplotlib.ticker import NullLocator  # noqa: E402

from measuring.statistics import column, mean  # noqa: E402
from measuring.tables import LEVELS  # noqa: E402


def save(figure, folder, name):
    figure.tight_layout()
    figure.savefig(os.path.join(folder, name), dpi=100)
    plt.close(figure)


def mark_values(axis, values):
    """Ticks at what was measured, written as numbers rather than powers of ten."""
    values = sorted(set(values))
    axis.set_ticks(values)
    axis.set_ticklabels(["%g" % value for value in values])
    axis.set_minor_locator(NullLocator())


def plot_levels(folder, name, measured):
    figure, axes = plt.subplots(figsize=(7, 4))
    for i, (method, rows) in enumerate(measured["rows"].items()):
        axes.bar([level + 0.2 * (i - 1.5) for level in LEVELS],
                 [mean(column(rows, "ms_%d" % level)) for level in LEVELS], 0.2, label=method)
    axes.set_xlabel("level")
    axes.set_ylabel("processor time, ms")
    axes.set_title(name)
    axes.legend()
    save(figure, folder, "levels_%s.png" % name)


def plot_frames(folder, name, measured):
    rows = measured["rows"]["default"]
    figure, axes = plt.subplots(figsize=(9, 4))
    stages = [column(rows, "ms_" + stage) for stage in ("pyramid", "tracking", "keyframe")]
    axes.stackplot(range(1, len(rows) + 1), stages, labels=("pyramid", "tracking", "keyframe"))
    axes.set_xlabel("frame")
    axes.set_ylabel("processor time, ms")
    axes.set_title(name)
    axes.legend()
    save(figure, folder, "frames_%s.png" % name)


def plot_sizes(folder, sizes):
    figure, axes = plt.subplots(figsize=(6, 4))
    for method in ("ssd", "mi", "hybrid", "default"):
        points = [(width, ms) for width, name, ms in sizes if name == method]
        axes.loglog([width for width, _ in points], [ms for _, ms in points], "o-", label=method)
    mark_values(axes.xaxis, [width for width, _, _ in sizes])
    axes.set_xlabel("image width, pixels")
    axes.set_ylabel("median ms per frame")
    axes.legend()
    save(figure, folder, "sizes.png")


def plot_parameter(folder, name, rows):
    figure, axes = plt.subplots(figsize=(6, 4))
    axes.semilogx([value for value, _ in rows], [ms for _, ms in rows], "o-")
    mark_values(axes.xaxis, [value for value, _ in rows])
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel(name)
    axes.set_ylabel("median ms per frame")
    save(figure, folder, name + ".png")
